#include "servo/safety/jaw_watch.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr double rig_sigmas = 2.0;        // of the rig's word and the jitter together
constexpr double jitter_sigmas = 3.0;     // beyond what was seen
constexpr double report_error_s = 0.002;  // of a travel that is polled, in whole counts

}  // namespace

void JawWatch::observe(const ThrowerObservation& o) {
  if (trial_ == Trial::none || !o.gripper) return;
  if (!timed_ && o.gripper->freed_at && *o.gripper->freed_at >= ordered_) {
    const double delay_s = seconds(*o.gripper->freed_at - ordered_);
    if (!seen_) seen_ = {delay_s, delay_s};
    seen_ = {std::min(seen_->least_s, delay_s), std::max(seen_->most_s, delay_s)};
    timed_ = true;
  }
  if (o.gripper->open) trial_ = Trial::open;
  if (trial_ == Trial::open && o.gripper->holding && !o.gripper->open) trial_ = Trial::none;
}

void JawWatch::permitted(JawTrial trial, Stamp now) {
  if (trial != JawTrial::open || trial_ != Trial::none) return;
  trial_ = Trial::ordered;
  ordered_ = now;
  timed_ = false;
}

DelayBounds JawWatch::delay() const {
  if (!seen_) {
    const double unsure_s = rig_sigmas * std::hypot(config_.gripper_delay_sigma_s, config_.gripper_jitter_s);
    return {std::max(0.0, config_.gripper_delay_s - unsure_s), config_.gripper_delay_s + unsure_s};
  }
  const double unsure_s = jitter_sigmas * config_.gripper_jitter_s + report_error_s;
  return {std::max(0.0, seen_->least_s - unsure_s), seen_->most_s + unsure_s};
}

}  // namespace hogline::servo
