// The low view over a run: each frame is predicted from the ones before, and when the hog line has left the bottom of
// the picture the distance is carried on by dead reckoning from the last good frames.
#pragma once

#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "vision/low_view.hpp"

namespace hogline::vision {

/// A body's motion at constant velocity, by least squares over the last frames.
struct SteadyMotion {
  PlanarPose at;  ///< smoothed, at the newest frame
  PlanarSigma at_sigma;
  double x_mps = 0.0;  ///< in e
  double y_mps = 0.0;
  double yaw_radps = 0.0;
  double speed_sigma_mps = 0.0;
  double yaw_rate_sigma_radps = 0.0;
};

class LowSequence {
 public:
  explicit LowSequence(const CameraSetup& setup) : setup_(setup), view_(setup) {}

  /// One frame; stamps must grow (a stamp that does not is refused: ok == false). Dead-reckoned results are ok, name
  /// "dead_reckoning" among their features and say so in growing sigmas; they end after `longest_blind_s`.
  SheetPosePercept step(const cv::Mat& image, Stamp stamp, LowViewSketch* sketch = nullptr);

  /// What the frames so far say of the next one. Nothing before the first good frame.
  LowViewPrediction predict(Stamp stamp) const;

  static constexpr double longest_blind_s = 0.5;

 private:
  struct Look {
    Stamp stamp;
    SheetPosePercept percept;
  };

  std::optional<SteadyMotion> motion() const;
  std::optional<SheetPosePercept> dead_reckoned(Stamp stamp) const;
  bool hog_line_below(const PlanarPose& body) const;

  CameraSetup setup_;
  LowView view_;
  std::deque<Look> seen_;  ///< the last good frames
  std::optional<double> width_m_;
  std::optional<Stamp> last_stamp_;
};

}  // namespace hogline::vision
