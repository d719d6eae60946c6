// The joint fit from frame to frame: moving edges find where the paint has gone since the prediction, subpixel places
// and the joint fit say where exactly. A few hundred places instead of all, chosen by what they tell of the body's
// place and direction.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "vision/fit/sheet_fit.hpp"

namespace hogline::vision {

/// What the frames before say of this one.
struct SheetPrediction {
  Pose eMc;                                ///< of the camera in the middle of the exposure
  Eigen::Matrix<double, 6, 6> covariance;  ///< of its twist (translation first, c's axes): how wrong it may be
  Eigen::Matrix<double, 6, 1> travel;      ///< twist of the camera during the exposure: motion blur to expect
};

/// How the last frame was followed.
struct TrackDiagnosis {
  int places = 0;           ///< looked for
  int moved = 0;            ///< found by the moving edges
  double search_px = 0.0;   ///< the widest search
  double innovation = 0.0;  ///< of the fit beside the prediction, all six numbers together, in sigmas
};

/// Usage: begin() on a picture whose pose is known to a few pixels (an acquisition's); then follow() every frame. A
/// result that is not ok ends it: begin again. No memory is allocated by follow() after the first frames.
class SheetTrack {
 public:
  explicit SheetTrack(const CameraSetup& setup);
  ~SheetTrack();
  SheetTrack(SheetTrack&&) noexcept;
  SheetTrack& operator=(SheetTrack&&) noexcept;

  /// A whole fit (see SheetFit). The start's priors hold for the frames that follow too.
  const SheetFitResult& begin(const cv::Mat& image, const SheetFitStart& start);

  /// `ok == false` with a reason: lost. The fit itself does not use the prediction's covariance, only the search does:
  /// a result is a measurement of this frame alone. Precondition: begin() was ok.
  const SheetFitResult& follow(const cv::Mat& image, const SheetPrediction& prediction);

  /// What begin() or follow() returned last.
  const SheetFitResult& result() const;
  const TrackDiagnosis& diagnosis() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::vision
