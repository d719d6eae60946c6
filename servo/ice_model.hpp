// What is known of the ice: friction, curl and the floor's slope across, learnt throw by throw from trajectories.
//
// A throw is fitted by shooting (servo/throw_fit): positions predicted and compared, nothing differentiated. What it
// says of the ice becomes the prior of the next. Frame s throughout (the delivering end's, y down-ice, which is also
// the thrower's e up to a shift along y).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "servo/stone_motion_model.hpp"
#include "servo/throw_fit.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline::servo {

/// How far ice can be from FCV1 before anything was thrown, and how it changes.
struct IceModelConfig {
  double friction_sigma = 0.12;  ///< simulators draw 0.85-1.20; arenas differ as much
  double curl_mean = 0.85;       ///< simulators draw 0.6-1.1
  double curl_sigma = 0.2;
  double lateral_sigma_mps2 = 3e-4;
  double friction_drift = 0.002;  ///< from throw to throw, for good: pebble wears, one standard deviation
  double curl_drift = 0.005;
  double lateral_drift_mps2 = 1e-5;
};

/// What can be foretold of a place.
struct StopPrediction {
  double x_m = 0.0;
  double y_m = 0.0;
  double after_s = 0.0;
  PlaceCovariance covariance;
};

class IceModel {
 public:
  explicit IceModel(const IceModelConfig& config, const ThrowFitConfig& fit = {});
  /// Goes on from what was saved. Precondition: no refusal(saved).
  IceModel(const IceModelConfig& config, const IceEstimate& saved, const ThrowFitConfig& fit = {});

  /// Fits a throw and takes in what it says of the ice. A fit that is not ok leaves the estimate as it is.
  ThrowFit learn(const ThrowTrack& track);

  const IceEstimate& estimate() const { return estimate_; }
  /// One throw's ice: the estimate with the scatter from throw to throw on top.
  Eigen::Matrix3d throw_covariance() const;

 private:
  IceModelConfig config_;
  ThrowFitConfig fit_;
  IceEstimate estimate_;
};

/// Why an estimate read from somewhere can not be one of ice; nothing when it can.
std::optional<std::string> refusal(const IceEstimate& estimate);

/// Where a running stone will stop. `covariance` of its x, y, vx, vy and of friction, curl and lateral acceleration.
StopPrediction predict_stop(const SlidingStone& stone, const IceFactors& ice,
                            const Eigen::Matrix<double, 7, 7>& covariance);

}  // namespace hogline::servo
