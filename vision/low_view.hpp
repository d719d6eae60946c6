// Low-view distance to the hog line, lateral offset and yaw, of the running thrower.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "vision/camera_setup.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline::vision {

class SheetFit;

/// What is known before the frame: from the near view, from the last frame and odometry. Nothing of it is needed.
struct LowViewPrediction {
  std::optional<double> sheet_width_m;  ///< as the near view measured it
  std::optional<PlanarPose> body;       ///< where the body should be
  PlanarSigma body_sigma;               ///< of `body`, where it is given
};

/// What was seen on the way, in pixels of the raw picture.
struct LowViewSketch {
  std::vector<std::vector<Eigen::Vector2d>> candidates;  ///< poly-lines, bent by the lens
  std::vector<std::vector<Eigen::Vector2d>> chosen;      ///< the H: hog line and what runs down-ice
  std::vector<std::vector<Eigen::Vector2d>> model;       ///< the painted sheet where the estimate puts it
};

class LowView {
 public:
  explicit LowView(const CameraSetup& setup);
  ~LowView();
  LowView(LowView&&) noexcept;
  LowView& operator=(LowView&&) noexcept;

  /// One frame on its own, or with a prediction. `image` as for NearView::acquire.
  SheetPosePercept acquire(const cv::Mat& image, Stamp stamp, const LowViewPrediction& prediction = {},
                           LowViewSketch* sketch = nullptr);

  /// The fit behind the last acquire() that was ok, for a tracker to take over.
  const SheetFit& fit() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
