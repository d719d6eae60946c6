#include "servo/yaw_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::servo {
namespace {

// A turn ends when the error that stopping leaves is below this part of the tolerance.
constexpr double stop_part = 1.0 / 3.0;
// Braking is planned with this part of the allowed yaw acceleration; the rest is for the drive's lag.
constexpr double braking_part = 0.5;

}  // namespace

YawAlignment::YawAlignment(const AlignmentConfig& config, const MotionLimits& limits, double target_heading_rad)
    : config_(config), limits_(limits), target_rad_(target_heading_rad), task_(config, target_heading_rad) {}

AlignmentStep YawAlignment::step(double heading_rad, double rate_radps, Duration dt) {
  AlignmentStep step;
  const VanishingPointLaw law = task_.law(heading_rad);
  if (!law.ok || !std::isfinite(rate_radps)) {
    step.reason = law.ok ? "rate of turn is not finite" : law.reason;
    return step;
  }
  const double error_rad = std::remainder(target_rad_ - heading_rad, 2.0 * std::numbers::pi);
  ordered_radps_ = limited(turn(error_rad, law.yaw_rate_radps, rate_radps), error_rad, seconds(dt));
  judge(error_rad, rate_radps, dt);
  step.ok = true;
  step.yaw_rate_radps = ordered_radps_;
  step.error_rad = error_rad;
  step.settled = within_ >= config_.settle_time;
  return step;
}

// Stiction: a turn is never slower than the rate that breaks away, ends early by what the body turns on, and begins
// again only outside the tolerance. So the body either moves surely or stands: no limit cycle.
double YawAlignment::turn(double error_rad, double wanted_radps, double rate_radps) {
  const double left_rad = error_rad - rate_radps * config_.stopping_lag_s;
  const bool arrived = std::abs(left_rad) < stop_part * config_.tolerance_rad || left_rad * error_rad < 0.0;
  if (turning_ && arrived) turning_ = false;
  if (!turning_ && !arrived && std::abs(error_rad) > config_.tolerance_rad) turning_ = true;
  if (!turning_) return 0.0;
  return std::copysign(std::max(std::abs(wanted_radps), config_.breakaway_yaw_rate_radps), wanted_radps);
}

double YawAlignment::limited(double wanted_radps, double error_rad, double dt_s) const {
  const double stoppable =
      std::max(std::sqrt(2.0 * braking_part * limits_.max_yaw_acceleration_radps2 * std::abs(error_rad)),
               config_.breakaway_yaw_rate_radps);
  const double bound = std::min(limits_.max_yaw_rate_radps, stoppable);
  const double change = limits_.max_yaw_acceleration_radps2 * dt_s;
  return std::clamp(std::clamp(wanted_radps, -bound, bound), ordered_radps_ - change, ordered_radps_ + change);
}

void YawAlignment::judge(double error_rad, double rate_radps, Duration dt) {
  const bool within =
      std::abs(error_rad) <= config_.tolerance_rad && std::abs(rate_radps) <= config_.rate_tolerance_radps && !turning_;
  within_ = within ? within_ + dt : Duration::zero();
}

}  // namespace hogline::servo
