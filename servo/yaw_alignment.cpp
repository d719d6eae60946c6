#include "servo/yaw_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::servo {
namespace {

// What the body turns on after the order ends is learnt within these bounds, once it stands again.
constexpr double longest_lag_s = 0.2;
constexpr auto standing_time = std::chrono::milliseconds(100);
// Braking is planned with this part of the allowed yaw acceleration; the rest is for the drive's lag.
constexpr double braking_part = 0.5;

}  // namespace

YawAlignment::YawAlignment(const AlignmentConfig& config, const MotionLimits& limits, double target_heading_rad)
    : config_(config),
      limits_(limits),
      target_rad_(target_heading_rad),
      task_(config, target_heading_rad),
      lag_s_(config.stopping_lag_s) {}

AlignmentStep YawAlignment::step(double heading_rad, double rate_radps, Duration dt) {
  AlignmentStep step;
  const VanishingPointLaw law = task_.law(heading_rad);
  if (!law.ok || !std::isfinite(rate_radps)) {
    step.reason = law.ok ? "rate of turn is not finite" : law.reason;
    return step;
  }
  const double error_rad = std::remainder(target_rad_ - heading_rad, 2.0 * std::numbers::pi);
  ordered_radps_ = limited(turn(error_rad, law.yaw_rate_radps, rate_radps, dt), error_rad, seconds(dt));
  learn_lag(error_rad, rate_radps, dt);
  judge(error_rad, rate_radps, dt);
  step.ok = true;
  step.yaw_rate_radps = ordered_radps_;
  step.error_rad = error_rad;
  step.settled = within_ >= config_.settle_time;
  return step;
}

// Stiction: a turn is never slower than the rate that breaks away, ends early by what the body turns on, and begins
// again only outside the tolerance. So the body either moves surely or stands: no limit cycle.
double YawAlignment::turn(double error_rad, double wanted_radps, double rate_radps, Duration dt) {
  const double left_rad = error_rad - rate_radps * lag_s_;
  const bool arrived = std::abs(left_rad) < 0.5 * std::abs(rate_radps) * seconds(dt) || left_rad * error_rad < 0.0;
  if (turning_ && arrived) {
    turning_ = false;
    ended_ = Ended{error_rad, rate_radps};
    standing_ = Duration::zero();
  }
  if (!turning_ && !arrived && std::abs(error_rad) > config_.tolerance_rad) turning_ = true;
  if (!turning_) return 0.0;
  return std::copysign(std::max(std::abs(wanted_radps), config_.breakaway_yaw_rate_radps), wanted_radps);
}

// Drives differ, and a body with stiction stops earlier than one without: the next turn ends by what this one did.
void YawAlignment::learn_lag(double error_rad, double rate_radps, Duration dt) {
  if (turning_) ended_.reset();
  if (!ended_) return;
  standing_ = std::abs(rate_radps) <= config_.rate_tolerance_radps ? standing_ + dt : Duration::zero();
  if (standing_ < standing_time) return;
  if (ended_->rate_radps != 0.0) {
    lag_s_ = std::clamp((ended_->error_rad - error_rad) / ended_->rate_radps, 0.0, longest_lag_s);
  }
  ended_.reset();
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
