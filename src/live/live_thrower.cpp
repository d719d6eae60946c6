#include "src/live/live_thrower.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "src/config/config_error.hpp"

namespace hogline {
namespace {

using servo::ThrowerState;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration arming_limit = seconds(15);  // two boots of the drives
constexpr Duration rearm_period = milliseconds(1500);
constexpr Duration publish_period = milliseconds(200);
constexpr Duration order_age_limit = seconds(2);
constexpr double slowest_mps = 0.5;
constexpr double widest_heading_rad = 20.0 * std::numbers::pi / 180.0;

hw::link::OrderGateConfig gate_config(const config::ThrowerRig& rig, std::uint64_t session) {
  if (!rig.link || rig.link->commander.empty()) {
    throw config::ConfigError(rig.rig.file, 0, "link.commander", "", "missing; whose orders are thrown?");
  }
  return {.commander = rig.link->commander,
          .session = session,
          .longest_age = order_age_limit,
          .commander_gone = hw::link::liveliness_lease};
}

std::array<std::optional<hw::DeviceError>, 6> errors_of(const ThrowerDevices& d) {
  return {d.drive.state().error, d.gripper.state().error, d.arm.state().error,
          d.gyro.state().error,  d.near_camera.error(),   d.low_camera.error()};
}

std::string words_of(const hw::DeviceError& e) {
  return fmt::format("{}: {}: {}", e.device, to_string(e.kind), e.what);
}

// By the wheels alone, as the thrower's loop has it.
bool stands(const hw::DriveState& drive) {
  constexpr double standing_radps = 0.002;
  return drive.stamp != Stamp{} && !drive.error && std::abs(drive.measured.left_radps) < standing_radps &&
         std::abs(drive.measured.right_radps) < standing_radps;
}

servo::ShotOrder shot_of(const hw::ShotOrderMessage& order) {
  return {.speed_mps = order.speed_mps,
          .heading_rad = order.heading_rad,
          .curl = order.spin_radps < 0.0 ? servo::Curl::clockwise : servo::Curl::counter_clockwise,
          .spin_radps = std::abs(order.spin_radps)};
}

}  // namespace

const char* to_string(LivePhase phase) {
  switch (phase) {
    case LivePhase::disarmed:
      return "disarmed";
    case LivePhase::arming:
      return "arming";
    case LivePhase::armed:
      return "armed";
    case LivePhase::throwing:
      return "throwing";
  }
  return "";
}

/// One throw under way: looks in a thread of its own, as throws against the wall clock have it.
struct LiveThrower::Throw {
  Throw(const config::ThrowerRig& rig, const ThrowerDevices& devices, std::unique_ptr<SheetSeer> sees,
        const hw::ShotOrderMessage& ordered, Stamp now)
      : order(ordered),
        seer(std::move(sees)),
        looking(*seer, devices.near_camera, devices.low_camera, devices.clock),
        loop({devices.drive, devices.gripper, devices.arm, devices.gyro, looking.near_camera(), looking.low_camera(),
              devices.operator_switch, devices.clock},
             ThrowerEyes(looking.seer(), LookTimes{}), servo::Thrower(rig.thrower, shot_of(ordered), now),
             servo::Supervisor(rig.thrower)) {}

  hw::ShotOrderMessage order;
  std::unique_ptr<SheetSeer> seer;
  VisionThread looking;
  ThrowerLoop loop;
  std::optional<hw::DeviceError> outside;
  std::optional<ThrowerState> told;
  bool release_told = false;
};

LiveThrower::LiveThrower(const config::ThrowerRig& rig, const ThrowerDevices& devices, hw::TeamLink& link,
                         MakeSeer make_seer, Tell tell)
    : rig_(rig),
      devices_(devices),
      post_(rig.link.value(), link),
      gate_(gate_config(rig, link.state().session)),
      make_seer_(std::move(make_seer)),
      tell_(std::move(tell)) {}

LiveThrower::~LiveThrower() = default;

void LiveThrower::step(Stamp now, Duration dt) {
  for (const hw::ReceivedMessage& received : post_.step(now)) hear(received, now);
  if (throw_) {
    step_throw(now, dt);
  } else {
    step_devices(now);
    watch_switch(now);
    if (phase_ == LivePhase::arming) step_arming(now);
    if (phase_ == LivePhase::armed) watch_armed(now);
  }
  publish(now);
}

void LiveThrower::step_devices(Stamp now) {
  devices_.drive.step(now);
  devices_.gripper.step(now);
  devices_.arm.step(now);
  devices_.gyro.at_rest(stands(devices_.drive.state()));
  devices_.gyro.step(now);
  devices_.operator_switch.step(now);
}

// ---- arming ----

bool LiveThrower::held(Stamp now) const {
  const hw::OperatorSwitchState state = devices_.operator_switch.state();
  return state.held && now - state.stamp <= rig_.thrower.safety.operator_age;
}

void LiveThrower::watch_switch(Stamp now) {
  if (!held(now)) {
    seen_free_ = true;
    if (phase_ == LivePhase::arming || phase_ == LivePhase::armed) disarm("the operator's switch was let go");
    return;
  }
  if (phase_ != LivePhase::disarmed || !seen_free_ || ended_) return;
  seen_free_ = false;
  arming_since_ = now;
  next_rearm_ = now;
  post_.lift_stops();
  enter(LivePhase::arming, {});
}

// Devices that were away come back one after the other: each is given time, and asked again.
void LiveThrower::step_arming(Stamp now) {
  const auto problem = not_ready(now);
  if (!problem) return enter(LivePhase::armed, {});
  if (now - arming_since_ > arming_limit) return disarm("not armed: " + *problem);
  if (now < next_rearm_) return;
  next_rearm_ = now + rearm_period;
  rearm_devices();
}

void LiveThrower::rearm_devices() {
  const ThrowerDevices& d = devices_;
  if (d.drive.state().error) d.drive.rearm();
  if (d.gripper.state().error) d.gripper.rearm();
  if (d.arm.state().error) d.arm.rearm();
  if (d.gyro.state().error) d.gyro.rearm();
  if (d.near_camera.error()) d.near_camera.rearm();
  if (d.low_camera.error()) d.low_camera.rearm();
  if (d.gripper.state().jaws == hw::JawState::open) d.gripper.grip();  // the next stone stands between them
}

std::optional<std::string> LiveThrower::not_ready(Stamp now) const {
  for (const auto& error : errors_of(devices_))
    if (error) return words_of(*error);
  if (const auto trouble = post_.trouble(now)) return words_of(*trouble);
  const hw::DriveState drive = devices_.drive.state();
  if (drive.phase != hw::DrivePhase::ready && drive.phase != hw::DrivePhase::stopped) return "the drives boot";
  if (!stands(drive)) return "the wheels turn, or are not known to stand";
  const hw::GripperState gripper = devices_.gripper.state();
  if (now - gripper.stamp > rig_.thrower.ages.gripper) return "nothing is known of the jaws";
  if (gripper.jaws != hw::JawState::holding) return "no stone is held";
  if (now - devices_.arm.state().stamp > rig_.thrower.ages.arm) return "nothing is known of the arm";
  if (!devices_.gyro.state().valid) return "nothing is known of the gyro";
  return std::nullopt;
}

void LiveThrower::watch_armed(Stamp now) {
  if (const auto problem = not_ready(now)) disarm(*problem);
}

void LiveThrower::disarm(const std::string& why) {
  fault_ = true;
  enter(LivePhase::disarmed, why);
}

void LiveThrower::enter(LivePhase phase, const std::string& why) {
  phase_ = phase;
  reason_ = why;
  if (phase != LivePhase::disarmed) fault_ = false;
  tell_(to_string(phase), why);
}

void LiveThrower::end(const std::string& why) {
  if (!ended_) ended_ = why;
  if (!throw_ && phase_ != LivePhase::disarmed) disarm(why);
}

// ---- orders ----

void LiveThrower::hear(const hw::ReceivedMessage& received, Stamp now) {
  gate_.heard(hw::origin_of(received.message), now);
  if (const auto* order = std::get_if<hw::ShotOrderMessage>(&received.message)) take_order(*order, now);
}

void LiveThrower::take_order(const hw::ShotOrderMessage& order, Stamp now) {
  const hw::link::OrderVerdict verdict = gate_.judge(order, post_.made_at(order.origin, now), now);
  const auto refusal = verdict.accepted ? not_now(order, now) : std::optional<std::string>(verdict.reason);
  if (!refusal) return begin_throw(order, now);
  tell_("refused", *refusal);
  if (!throw_ && !fault_) reason_ = "order refused: " + *refusal;
}

std::optional<std::string> LiveThrower::not_now(const hw::ShotOrderMessage& order, Stamp now) const {
  if (throw_) return "another order is being thrown";
  if (phase_ != LivePhase::armed) return "the thrower is not armed";
  if (const auto problem = not_ready(now)) return problem;
  if (!(order.speed_mps >= slowest_mps && order.speed_mps <= rig_.thrower.limits.max_speed_mps)) {
    return fmt::format("a speed of {:.2f} m/s: {} to {} can be thrown", order.speed_mps, slowest_mps,
                       rig_.thrower.limits.max_speed_mps);
  }
  if (!(std::abs(order.heading_rad) <= widest_heading_rad)) return "a heading of more than 20 degrees";
  if (!(std::abs(order.spin_radps) <= rig_.gripper.max_spin_radps)) {
    return fmt::format("a spin of {:.1f} rad/s: the belt gives {}", order.spin_radps, rig_.gripper.max_spin_radps);
  }
  return std::nullopt;
}

void LiveThrower::begin_throw(const hw::ShotOrderMessage& order, Stamp now) {
  order_serial_ = order.origin.serial;
  throw_ = std::make_unique<Throw>(rig_, devices_, make_seer_(), order, now);
  throw_->loop.arm(now);
  enter(LivePhase::throwing,
        fmt::format("order {}: {:.3f} m/s, {:.2f} deg, {:+.2f} rad/s", order_serial_, order.speed_mps,
                    order.heading_rad * 180.0 / std::numbers::pi, order.spin_radps));
}

// ---- the throw ----

void LiveThrower::step_throw(Stamp now, Duration dt) {
  if (!throw_->outside) throw_->outside = post_.trouble(now);
  if (!throw_->outside && ended_) {
    throw_->outside = hw::DeviceError{hw::DeviceErrorKind::refused, "this program", *ended_, now};
  }
  throw_->loop.set_outside_error(throw_->outside);
  throw_->loop.step(now, dt);
  const servo::Thrower& thrower = throw_->loop.thrower();
  if (throw_->told != thrower.state()) tell_("state", servo::to_string(thrower.state()));
  throw_->told = thrower.state();
  if (thrower.abort_reason() && reason_ != *thrower.abort_reason()) {
    reason_ = *thrower.abort_reason();
    fault_ = true;
    tell_("aborted", reason_);
  }
  if (thrower.released() && !throw_->release_told && devices_.gripper.state().freed_at) tell_release(now);
  if (thrower.finished()) end_throw();
}

// The body went on since; where it was is told for the stone's centre at its own moment.
void LiveThrower::tell_release(Stamp now) {
  throw_->release_told = true;
  const servo::ThrowerDiagnosis& d = throw_->loop.thrower().diagnosis();
  const Stamp freed = *devices_.gripper.state().freed_at;
  const double since_s = hogline::seconds(now - freed);
  const ThrowerEyes& eyes = throw_->loop.eyes();
  const auto& view = eyes.low_view() && eyes.low_view()->ok ? eyes.low_view() : eyes.near_view();
  const double body_x_m = view ? view->body.x_m : 0.0;
  hw::ReleaseMessage release;
  release.order_serial = order_serial_;
  release.hog_distance_m = d.hog_distance_m + since_s * d.speed_mps - rig_.thrower.release.stone_x_m;
  release.lateral_m = body_x_m - rig_.thrower.release.stone_x_m * std::sin(d.yaw_rad);
  release.speed_mps = d.freed_at_speed_mps.value_or(d.speed_mps) - rig_.thrower.release.drag_mps;
  release.heading_rad = d.yaw_rad;
  release.spin_radps = throw_->order.spin_radps;
  post_.send(release, freed);
  tell_("released",
        fmt::format("{:.3f} m before the hog line at {:.3f} m/s", release.hog_distance_m, release.speed_mps));
}

void LiveThrower::end_throw() {
  const bool released = throw_->loop.thrower().released();
  const std::string why = throw_->loop.thrower().abort_reason().value_or("");
  for (const hw::DeviceError& error : throw_->loop.device_errors()) tell_("device error", words_of(error));
  throw_.reset();
  seen_free_ = false;
  fault_ = !why.empty();
  enter(LivePhase::disarmed, why);
  tell_("thrown", released ? "the stone was let go" : "the stone was kept");
}

std::optional<Stamp> LiveThrower::release_due() const { return throw_ ? throw_->loop.release_due() : std::nullopt; }

void LiveThrower::let_go(Stamp now) {
  if (throw_) throw_->loop.let_go(now);
}

// ---- what the others are told ----

hw::ThrowerPhase LiveThrower::wire_phase() const {
  using hw::ThrowerPhase;
  if (!throw_)
    return fault_                                                ? ThrowerPhase::fault
           : order_serial_ != 0 && phase_ == LivePhase::disarmed ? ThrowerPhase::stopped
                                                                 : ThrowerPhase::idle;
  const servo::Thrower& thrower = throw_->loop.thrower();
  if (thrower.released()) return ThrowerPhase::released;
  if (thrower.abort_reason()) return ThrowerPhase::fault;
  return thrower.state() < ThrowerState::run ? ThrowerPhase::aligning : ThrowerPhase::running;
}

void LiveThrower::publish(Stamp now) {
  Published present{wire_phase(), phase_ == LivePhase::armed || phase_ == LivePhase::throwing, order_serial_, reason_};
  if (present == published_ && now - published_at_ < publish_period) return;
  published_ = present;
  published_at_ = now;
  hw::ThrowerStateMessage message;
  message.phase = present.phase;
  message.armed = present.armed;
  message.order_serial = present.order_serial;
  message.reason = present.reason;
  post_.send(std::move(message), now);
}

}  // namespace hogline
