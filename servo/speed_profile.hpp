// The speed set-point of the run: from rest to the shot's speed within acceleration and jerk, then held.
#pragma once

#include "servo/thrower_config.hpp"

namespace hogline::servo {

/// Closed form, symmetric: the acceleration rises with the jerk limit, stays at its limit where there is time for it,
/// falls with the jerk limit. Pure functions of the time since the start.
class SpeedProfile {
 public:
  /// Precondition: speed > 0, acceleration > 0, jerk > 0, all finite.
  SpeedProfile(double speed_mps, double max_acceleration_mps2, double max_jerk_mps3);

  double speed_mps(double time_s) const;
  double acceleration_mps2(double time_s) const;
  double travelled_m(double time_s) const;
  double duration_s() const { return 2.0 * ramp_s_ + constant_s_; }
  /// From rest until the speed is reached.
  double distance_m() const { return final_mps_ * duration_s() / 2.0; }

 private:
  double final_mps_;
  double jerk_mps3_;
  double ramp_s_;      ///< of each change of the acceleration
  double constant_s_;  ///< at the greatest acceleration
};

/// From this speed to rest at a constant deceleration, after moving on for the reaction time.
double stopping_distance_m(double speed_mps, double deceleration_mps2, double reaction_s);

}  // namespace hogline::servo
