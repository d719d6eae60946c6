#include "servo/thrower.hpp"

#include <cmath>
#include <utility>

#include "servo/refusal.hpp"
#include "servo/thrower_impl.hpp"

namespace hogline::servo {

const char* to_string(ThrowerState state) {
  switch (state) {
    case ThrowerState::unfold:
      return "unfold";
    case ThrowerState::rehearse:
      return "rehearse";
    case ThrowerState::measure:
      return "measure";
    case ThrowerState::align:
      return "align";
    case ThrowerState::fold:
      return "fold";
    case ThrowerState::run:
      return "run";
    case ThrowerState::release:
      return "release";
    case ThrowerState::brake:
      return "brake";
    case ThrowerState::stopped:
      return "stopped";
  }
  return "unknown";
}

Thrower::Impl::Impl(const ThrowerConfig& config_in, const ShotOrder& order_in, Stamp start)
    : config(config_in),
      order(order_in),
      agreement(config_in.safety),
      estimate(config_in, start),
      rehearsal(config_in.release.rehearsals, config_in.release.gripper_jitter_s) {
  history.push_back({state, start});
  abort.set(refusal(config, order));
}

ThrowerCommand Thrower::Impl::step(const ThrowerObservation& observation, Duration dt) {
  if (state != ThrowerState::stopped) abort.set(judge(observation, dt));

  ThrowerCommand command;
  if (!abort.reason()) {
    estimate.update(observation, use());
    abort.set(estimate.contradiction());
  }
  if (!abort.reason()) command = act(observation, dt);
  if (abort.reason()) command = stop_for_good(observation, dt);

  last_now = observation.now;
  diagnose(observation.now);
  return command;
}

std::optional<std::string> Thrower::Impl::judge(const ThrowerObservation& observation, Duration dt) {
  const std::string in_state = std::string(" (") + to_string(state) + ")";
  if (last_now && observation.now < *last_now) return "control period: time goes back" + in_state;
  if (observation.safety_stop) return "safety: " + *observation.safety_stop + in_state;
  if (auto reason = bad_input(observation, dt, needs(observation), config)) return *reason + in_state;
  if (observation.now - history.back().since > deadline()) {
    if (state == ThrowerState::release && !observation.gripper->open) release_ordered = false;
    return std::string("deadline of ") + to_string(state) + " passed" + missing_view(observation);
  }
  if (state == ThrowerState::unfold || state == ThrowerState::rehearse || state == ThrowerState::measure) {
    return std::nullopt;
  }
  const double gyro_radps = estimate.heading(observation.now).rate_radps;
  if (auto reason = agreement.judge(gyro_radps, estimate.odometry().yaw_rate_radps, dt)) return *reason + in_state;
  return std::nullopt;
}

// What a measurement, or a rehearsal that does not begin, has waited for.
std::string Thrower::Impl::missing_view(const ThrowerObservation& o) const {
  if (state != ThrowerState::measure && state != ThrowerState::rehearse) return {};
  if (!o.near_view || o.near_view->stamp < history.back().since) return ": no picture of the near camera";
  return o.near_view->ok ? "" : ": near view: " + o.near_view->reason;
}

ThrowerCommand Thrower::Impl::act(const ThrowerObservation& observation, Duration dt) {
  switch (state) {
    case ThrowerState::unfold:
      return unfold(observation);
    case ThrowerState::rehearse:
      return rehearse(observation);
    case ThrowerState::measure:
      return measure(observation);
    case ThrowerState::align:
      return align(observation, dt);
    case ThrowerState::fold:
      return fold(observation, dt);
    case ThrowerState::run:
      return run(observation, dt);
    case ThrowerState::release:
      return release(observation, dt);
    case ThrowerState::brake:
      return brake(observation, dt);
    case ThrowerState::stopped:
      return stopped();
  }
  return stopped();
}

// The stone is kept, unless its release has been ordered: jaws that close on a stone that slides would burn it.
ThrowerCommand Thrower::Impl::stop_for_good(const ThrowerObservation& observation, Duration dt) {
  if (state != ThrowerState::brake && state != ThrowerState::stopped) enter(ThrowerState::brake, observation.now);
  speed_setpoint_mps = 0.0;
  released = released || (release_ordered && observation.gripper && observation.gripper->open);
  at_rest = at_rest || has_come_to_rest(observation, dt);
  const bool over = at_rest || observation.now - history.back().since > config.deadlines.brake;
  if (state == ThrowerState::brake && over) enter(ThrowerState::stopped, observation.now);
  ThrowerCommand command = stopped();
  if (!at_rest) command.drive.order = DriveOrder::quick_stop;
  return command;
}

void Thrower::Impl::enter(ThrowerState next, Stamp now) {
  state = next;
  history.push_back({next, now});
}

InputNeeds Thrower::Impl::needs(const ThrowerObservation& o) const {
  const Stamp since = history.back().since;
  const bool near_came = o.near_view && o.near_view->stamp >= since;
  InputNeeds moving{.wheels = true, .enabled = true, .gyro = true, .gripper = true, .holding = true, .arm = true};
  switch (state) {
    case ThrowerState::unfold:
      return {.wheels = o.wheels.has_value(), .gripper = o.gripper.has_value(), .arm = o.arm.has_value()};
    case ThrowerState::rehearse:
      return {.wheels = true, .gyro = true, .gripper = true, .arm = true, .near_view = near_came};
    case ThrowerState::measure:
      moving.enabled = false;
      moving.near_view = near_came;
      return moving;
    case ThrowerState::align:
      moving.near_view = true;
      return moving;
    case ThrowerState::fold:
      return moving;
    case ThrowerState::run:
      moving.low_view = true;
      return moving;
    case ThrowerState::release:
      return {.wheels = true, .enabled = true, .gyro = true, .gripper = true};
    case ThrowerState::brake:
      return {.wheels = true, .enabled = true, .gyro = true};
    case ThrowerState::stopped:
      return {};
  }
  return moving;
}

EstimateUse Thrower::Impl::use() const {
  switch (state) {
    case ThrowerState::measure:
      return {.standing = true};
    case ThrowerState::align:
      return {.near_view = config.alignment.method == AlignmentMethod::visual_servoing};
    case ThrowerState::fold:
    case ThrowerState::run:
    case ThrowerState::release:
      return {.low_view = true};
    default:
      return {};
  }
}

Duration Thrower::Impl::deadline() const {
  switch (state) {
    case ThrowerState::unfold:
      return config.deadlines.unfold;
    case ThrowerState::rehearse:
      return config.deadlines.rehearse;
    case ThrowerState::measure:
      return config.deadlines.measure;
    case ThrowerState::align:
      return config.deadlines.align;
    case ThrowerState::fold:
      return config.deadlines.fold;
    case ThrowerState::run:
      return config.deadlines.run;
    case ThrowerState::release:
      return config.deadlines.release;
    case ThrowerState::brake:
      return config.deadlines.brake;
    case ThrowerState::stopped:
      return Duration::max();
  }
  return Duration::zero();
}

void Thrower::Impl::diagnose(Stamp now) {
  const HeadingEstimate heading = estimate.heading(now);
  diagnosis.yaw_rad = heading.yaw_rad;
  diagnosis.yaw_sigma_rad = heading.yaw_sigma_rad;
  diagnosis.speed_setpoint_mps = speed_setpoint_mps;
  if (!estimate.on_line()) return;
  const HogDistanceEstimate hog = estimate.hog_distance().at(now);
  diagnosis.hog_distance_m = hog.hog_distance_m;
  diagnosis.hog_distance_sigma_m = hog.hog_distance_sigma_m;
  diagnosis.lateral_m = estimate.lateral().lateral_m();
  diagnosis.speed_mps = hog.speed_mps;
}

Thrower::Thrower(const ThrowerConfig& config, const ShotOrder& order, Stamp start)
    : impl_(std::make_unique<Impl>(config, order, start)) {}
Thrower::~Thrower() = default;
Thrower::Thrower(Thrower&&) noexcept = default;
Thrower& Thrower::operator=(Thrower&&) noexcept = default;

ThrowerCommand Thrower::step(const ThrowerObservation& observation, Duration dt) {
  return impl_->step(observation, dt);
}
ThrowerState Thrower::state() const { return impl_->state; }
bool Thrower::finished() const { return impl_->state == ThrowerState::stopped; }
bool Thrower::released() const { return impl_->released; }
const std::optional<std::string>& Thrower::abort_reason() const { return impl_->abort.reason(); }
const std::vector<StateEntry>& Thrower::history() const { return impl_->history; }
const ThrowerDiagnosis& Thrower::diagnosis() const { return impl_->diagnosis; }

}  // namespace hogline::servo
