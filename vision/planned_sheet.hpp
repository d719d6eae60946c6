// The sheet's pose in consecutive pictures of a camera of which each picture's pose is roughly known beforehand: on a
// head whose joints are measured, on a body that stands. Tracked like the near view's sequence; where that fails, the
// same picture is fitted from where it was planned to be.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "vision/camera_setup.hpp"
#include "vision/fit/sheet_fit.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::vision {

class PlannedSheet {
 public:
  /// The setup's mount is not used but for the priors' axes: the plan says where the camera is.
  explicit PlannedSheet(const CameraSetup& setup);
  ~PlannedSheet();
  PlannedSheet(PlannedSheet&&) noexcept;
  PlannedSheet& operator=(PlannedSheet&&) noexcept;

  /// `planned` is the camera's pose at this picture's stamp, off by a third of a degree at most and by the same from
  /// picture to picture. The reference holds until the next call. `body` and `sigma` of the result are the mount's and
  /// of no use on a head.
  const SheetFitResult& look(const cv::Mat& image, Stamp stamp, const Pose& planned,
                             std::optional<double> sheet_width_m);

  /// The last picture was tracked; else fitted.
  bool tracked() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
