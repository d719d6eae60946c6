#include "servo/jaw_rehearsal.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hogline::servo {
namespace {

using namespace std::chrono_literals;

constexpr Duration steady_time = 100ms;  // the jaws press evenly again
constexpr Duration longest_delay = 500ms;
constexpr Duration longest_grip = 2s;
constexpr double scatter_sigmas = 8.0;  // between the shortest and the longest of a few delays

RehearsalStep ordered(JawTrial order) { return {.order = order, .done = false, .refused = {}}; }

RehearsalStep refused(std::string reason) {
  return {.order = JawTrial::none, .done = false, .refused = std::move(reason)};
}

bool holds(const GripperObservation& gripper) { return gripper.holding && !gripper.open; }

}  // namespace

RehearsalStep JawRehearsal::step(const GripperObservation& gripper, Stamp now) {
  switch (phase_) {
    case Phase::holding:
      return hold(gripper, now);
    case Phase::opening:
      return open(gripper, now);
    case Phase::gripping:
      return grip(gripper, now);
  }
  return {};
}

RehearsalStep JawRehearsal::hold(const GripperObservation& gripper, Stamp now) {
  if (!holds(gripper)) return refused("the stone is not held");
  if (!since_) since_ = now;
  if (now - *since_ < steady_time) return {};
  if (static_cast<int>(delays_s_.size()) >= times_) return finish();
  phase_ = Phase::opening;
  since_ = now;
  return ordered(JawTrial::open);
}

RehearsalStep JawRehearsal::open(const GripperObservation& gripper, Stamp now) {
  if (gripper.freed_at && *gripper.freed_at >= *since_) {
    delays_s_.push_back(seconds(*gripper.freed_at - *since_));
    phase_ = Phase::gripping;
    since_ = now;
    return ordered(JawTrial::grip);
  }
  if (now - *since_ > longest_delay) return refused("the jaws do not report that they let the stone go");
  return ordered(JawTrial::open);
}

RehearsalStep JawRehearsal::grip(const GripperObservation& gripper, Stamp now) {
  if (holds(gripper) && gripper.stamp > *since_) {
    phase_ = Phase::holding;
    since_ = now;
    return {};
  }
  if (now - *since_ > longest_grip) return refused("the jaws do not grip the stone again");
  return ordered(JawTrial::grip);
}

RehearsalStep JawRehearsal::finish() const {
  const auto [least, most] = std::minmax_element(delays_s_.begin(), delays_s_.end());
  if (!delays_s_.empty() && !(*most - *least <= scatter_sigmas * jitter_s_)) {
    std::ostringstream text;
    text.precision(3);
    text << "the jaws' delay is not even: from " << 1e3 * *least << " to " << 1e3 * *most << " ms";
    return refused(text.str());
  }
  return {.order = JawTrial::none, .done = true, .refused = {}};
}

}  // namespace hogline::servo
