#include "hw/canopen/feedback_check.hpp"

#include <cmath>
#include <cstdio>

namespace hogline::hw {
namespace {

// The memory of the comparison of position and integrated speed: long enough for a 10 % scale error to show, short
// enough for rounding in the drive's speed not to add up.
constexpr double mismatch_memory_s = 0.2;

}  // namespace

void FeedbackCheck::restart() {
  last_speed_radps_.reset();
  mismatch_rad_ = 0.0;
  diverged_since_.reset();
  problem_.reset();
}

void FeedbackCheck::report(const char* what, double value, double limit) {
  if (problem_) return;
  char text[160];
  std::snprintf(text, sizeof text, "%s: %.3g, limit %.3g", what, value, limit);
  problem_ = text;
}

void FeedbackCheck::on_feedback(double travel_rad, double speed_radps, Duration dt) {
  const double dt_s = seconds(dt);
  const double mean_speed_radps = 0.5 * (last_speed_radps_.value_or(speed_radps) + speed_radps);
  last_speed_radps_ = speed_radps;
  mismatch_rad_ = mismatch_rad_ * std::exp(-dt_s / mismatch_memory_s) + travel_rad - mean_speed_radps * dt_s;

  if (std::abs(mismatch_rad_) > limits_.position_mismatch_rad) {
    report("encoder position and speed disagree [rad]; check the encoder", mismatch_rad_,
           limits_.position_mismatch_rad);
  }
  if (std::abs(speed_radps) > 2.0 * max_speed_radps_) {
    report("impossible speed [rad/s]; check the encoder", speed_radps, 2.0 * max_speed_radps_);
  }
}

void FeedbackCheck::on_following(double target_radps, double speed_radps, Stamp now) {
  const double error_radps = speed_radps - target_radps;
  if (std::abs(error_radps) <= limits_.speed_error_radps) {
    diverged_since_.reset();
    return;
  }
  if (!diverged_since_) diverged_since_ = now;
  if (now - *diverged_since_ > limits_.speed_error_time) {
    report("speed does not follow the set-point [rad/s]", error_radps, limits_.speed_error_radps);
  }
}

}  // namespace hogline::hw
