#include "servo/speed_profile.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::servo {

SpeedProfile::SpeedProfile(double speed_mps, double max_acceleration_mps2, double max_jerk_mps3)
    : final_mps_(speed_mps),
      jerk_mps3_(max_jerk_mps3),
      ramp_s_(std::min(max_acceleration_mps2 / max_jerk_mps3, std::sqrt(speed_mps / max_jerk_mps3))),
      constant_s_(speed_mps / (max_jerk_mps3 * ramp_s_) - ramp_s_) {
  constant_s_ = std::max(constant_s_, 0.0);
}

double SpeedProfile::speed_mps(double time_s) const {
  if (time_s <= 0.0) return 0.0;
  if (time_s >= duration_s()) return final_mps_;
  if (time_s <= ramp_s_) return jerk_mps3_ * time_s * time_s / 2.0;
  const double left_s = duration_s() - time_s;
  if (left_s <= ramp_s_) return final_mps_ - jerk_mps3_ * left_s * left_s / 2.0;
  return jerk_mps3_ * ramp_s_ * (time_s - ramp_s_ / 2.0);
}

double SpeedProfile::acceleration_mps2(double time_s) const {
  const double left_s = duration_s() - time_s;
  if (time_s <= 0.0 || left_s <= 0.0) return 0.0;
  return jerk_mps3_ * std::min({time_s, ramp_s_, left_s});
}

double SpeedProfile::travelled_m(double time_s) const {
  if (time_s <= 0.0) return 0.0;
  if (time_s >= duration_s()) return distance_m() + final_mps_ * (time_s - duration_s());
  const double t = time_s;
  if (t <= ramp_s_) return jerk_mps3_ * t * t * t / 6.0;
  const double left_s = duration_s() - t;
  if (left_s <= ramp_s_) return distance_m() - final_mps_ * left_s + jerk_mps3_ * left_s * left_s * left_s / 6.0;
  const double u = t - ramp_s_;
  return jerk_mps3_ * ramp_s_ * (ramp_s_ * ramp_s_ / 6.0 + u * (ramp_s_ + u) / 2.0);
}

double stopping_distance_m(double speed_mps, double deceleration_mps2, double reaction_s) {
  return speed_mps * reaction_s + speed_mps * speed_mps / (2.0 * deceleration_mps2);
}

}  // namespace hogline::servo
