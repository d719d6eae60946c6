// One stone followed on the ice: an extended Kalman filter whose process model is the stone's own motion
// (servo/stone_motion_model), with the ice's factors as part of the state, and for each view the error that all its
// looks share. That error is why the far view hands over to the near view without a jump: what both saw of the same
// stone says how far the far view is tilted.
//
// Order of the nine: x, y, vx, vy; friction scale, curl gain, lateral acceleration; far view's and near view's shared
// error in their sigmas. Frame e of the skip: y falls as the stone comes.
#pragma once

#include <Eigen/Core>
#include <array>

#include "servo/stone_motion_model.hpp"
#include "servo/throw_fit.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

inline constexpr int motion_size = 7 + view_count;
using MotionCovariance = Eigen::Matrix<double, motion_size, motion_size>;

/// What the motion model does not know, per square root of a second.
struct MotionNoise {
  double place_m = 0.001;
  double velocity_mps = 0.004;
  double friction = 0.008;  ///< sweepers, and what one lane has and the next has not
  double curl = 0.02;
  double shared_time_s = 30.0;  ///< in which a view's shared error changes
};

/// What is known of one stone.
struct StoneMotion {
  Stamp stamp{};
  SlidingStone stone;
  IceFactors ice;
  std::array<double, view_count> shared_sigmas{};
  MotionCovariance covariance = MotionCovariance::Zero();

  bool at_rest() const { return stone.vx_mps == 0.0 && stone.vy_mps == 0.0; }
};

/// A look against what was expected of it.
struct Innovation {
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double square = 0.0;       ///< normalised
  double log_density = 0.0;  ///< of the look, per square metre
};

/// A stone that stands, seen with this covariance.
StoneMotion standing_stone(Stamp stamp, double x_m, double y_m, const PlaceCovariance& covariance,
                           const IceEstimate& ice);

/// A stone thought to run: sigmas of place and velocity along both axes. `spin_radps` 0 means that the sense is not
/// known: then it may curl either way.
StoneMotion running_stone(Stamp stamp, const SlidingStone& stone, double place_sigma_m, double velocity_sigma_mps,
                          const IceEstimate& ice, double throw_friction_sigma);

/// Of a stone that nobody watched turn: it may curl either way. Its curl gain gets a mean of 0 and a spread of either
/// sign, its spin becomes one that does not die.
void curl_either_way(StoneMotion& motion);
/// The same for a fit by shooting; the track then takes `either_way_spin_radps`.
IceEstimate curling_either_way(const IceEstimate& ice);
inline constexpr double either_way_spin_radps = 20.0;

/// Forward in time only: an earlier stamp changes nothing.
void advance(StoneMotion& motion, Stamp to, const MotionNoise& noise);

/// Preconditions: the motion is at the look's stamp; the look's covariance is positive definite.
Innovation innovation(const StoneMotion& motion, const TrackLook& look);
void correct(StoneMotion& motion, const TrackLook& look);

/// Of x, y, vx, vy and the ice's three: what predict_stop() wants.
inline Eigen::Matrix<double, 7, 7> motion_covariance(const StoneMotion& motion) {
  return motion.covariance.topLeftCorner<7, 7>();
}

}  // namespace hogline::servo
