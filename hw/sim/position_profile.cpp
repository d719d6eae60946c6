#include "hw/sim/position_profile.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::hw::sim {
namespace {

constexpr double position_gain_per_s = 20.0;  // of the drive's position loop, near the target

}  // namespace

void PositionProfile::hold(double position) {
  target_ = position;
  velocity_ = 0.0;
  waiting_.reset();
  offered_ = false;
  reached_ = true;
  inside_s_ = 0.0;
}

bool PositionProfile::offer(double target, bool immediately) {
  if (waiting_) return false;
  offered_ = true;
  if (immediately || reached_) {
    target_ = target;
    reached_ = false;
    inside_s_ = 0.0;
  } else {
    waiting_ = target;
  }
  return true;
}

double PositionProfile::step(double dt_s, double position, bool halt, const PositionProfileLimits& limits) {
  const double way = target_ - position;
  inside_s_ = std::abs(way) <= limits.window ? inside_s_ + dt_s : 0.0;
  if (inside_s_ > 0.0 && inside_s_ >= limits.window_time_s) reached_ = true;
  if (reached_ && waiting_) {
    target_ = *waiting_;
    waiting_.reset();
    reached_ = false;
    inside_s_ = 0.0;
  }

  const double braking = std::sqrt(2.0 * limits.deceleration * std::abs(way));
  const double fastest = std::min({limits.velocity, braking, position_gain_per_s * std::abs(way)});
  const double wanted = halt ? 0.0 : std::copysign(fastest, way);
  const bool faster = std::abs(wanted) > std::abs(velocity_);
  const double change = (faster ? limits.acceleration : 2.0 * limits.deceleration) * dt_s;
  velocity_ = std::clamp(wanted, velocity_ - change, velocity_ + change);
  return velocity_;
}

}  // namespace hogline::hw::sim
