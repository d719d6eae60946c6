// The joint fit from frame to frame: moving edges find where the paint has gone since the prediction, subpixel places
// and the joint fit say where exactly. A few hundred places instead of all, chosen by what they tell of the body's
// place and direction.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>

#include "vision/fit/place_choice.hpp"
#include "vision/fit/sheet_fit.hpp"

namespace hogline::vision {

/// What an earlier frame told of the camera's pitch. A body that rocks moves the picture: as long as that stands still,
/// what was known then holds.
struct PitchMemory {
  Pose eMc;                      ///< of that frame
  double offset_rad = 0.0;       ///< from the mount's, positive looks down more
  double sigma_rad = 0.0;        ///< of it
  double most_change_rad = 0.0;  ///< from then on, one standard deviation, however far the picture has moved
};

/// What the frames before say of this one.
struct SheetPrediction {
  Pose eMc;                                ///< of the camera in the middle of the exposure
  Eigen::Matrix<double, 6, 6> covariance;  ///< of its twist (translation first, c's axes): how wrong it may be
  Eigen::Matrix<double, 6, 1> travel;      ///< twist of the camera during the exposure: motion blur to expect
  std::optional<PitchMemory> pitch;        ///< in place of the start's prior on the pitch, which it falls back to
};

/// How the last frame was followed.
struct TrackDiagnosis {
  int places = 0;           ///< looked for
  int moved = 0;            ///< found by the moving edges
  double search_px = 0.0;   ///< the widest search
  double innovation = 0.0;  ///< of the fit beside the prediction, all six numbers together, in sigmas
  double moved_px = 0.0;  ///< of the picture since the frame of the pitch's memory, RMS over the places; 0 without one
  double pitch_offset_rad = 0.0;  ///< of the camera against its mount, as fitted, also after begin()
  double pitch_sigma_rad = 0.0;
};

/// Usage: begin() on a picture whose pose is known to a few pixels (an acquisition's); then follow() every frame. A
/// result that is not ok ends it: begin again. No memory is allocated by follow() after the first frames.
class SheetTrack {
 public:
  explicit SheetTrack(const CameraSetup& setup, const ChoiceWishes& wishes = {});
  ~SheetTrack();
  SheetTrack(SheetTrack&&) noexcept;
  SheetTrack& operator=(SheetTrack&&) noexcept;

  /// A whole fit (see SheetFit). The start's priors hold for the frames that follow too.
  const SheetFitResult& begin(const cv::Mat& image, const SheetFitStart& start);

  /// Takes a fit over that was ok, with all it found; `start` gives the priors that hold for the frames that follow.
  const SheetFitResult& begin(const SheetFit& fitted, const SheetFitStart& start);

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
