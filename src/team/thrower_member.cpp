#include "src/team/thrower_member.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "hw/link/link_config.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

constexpr Duration state_period = std::chrono::milliseconds(500);
constexpr Duration longest_age = std::chrono::seconds(2);
constexpr double standing_radps = 0.002;

// The line of an order over the link runs through the middle of the hack.
double release_x_m(double heading_rad, const servo::ReleaseConfig& release) {
  const double from_hack_m =
      vision::rules::tee_to_hack_m + vision::rules::tee_to_hog_m - release.hog_distance_m + release.stone_x_m;
  return -std::tan(heading_rad) * from_hack_m;
}

servo::ShotOrder order_of(const hw::ShotOrderMessage& m, const servo::ReleaseConfig& release) {
  return {.speed_mps = m.speed_mps,
          .heading_rad = m.heading_rad,
          .curl = m.spin_radps < 0.0 ? servo::Curl::clockwise : servo::Curl::counter_clockwise,
          .spin_radps = std::abs(m.spin_radps),
          .release_x_m = release_x_m(m.heading_rad, release)};
}

template <typename Device>
void clear(Device& device, const std::optional<hw::DeviceError>& error) {
  if (error) device.rearm();
}

}  // namespace

ThrowerMember::ThrowerMember(const config::ThrowerRig& rig, const ThrowerDevices& devices, Seers seers,
                             hw::TeamLink& link)
    : rig_(rig),
      devices_(devices),
      seers_(std::move(seers)),
      link_(link, "thrower", "skip"),
      gate_({.commander = "skip",
             .session = link.state().session,
             .longest_age = longest_age,
             .commander_gone = hw::link::heartbeat_deadline}) {}

void ThrowerMember::step(Stamp now, Duration dt) {
  link_.step(now);
  listen(now);
  throwing() ? run(now, dt) : stand_by(now);
  tell(now);
}

void ThrowerMember::listen(Stamp now) {
  while (const auto received = link_.receive(now)) {
    if (std::holds_alternative<hw::HeartbeatMessage>(received->message)) {
      gate_.heard(hw::origin_of(received->message), received->received);
      know_commander(now);
    }
    if (const auto* order = std::get_if<hw::ShotOrderMessage>(&received->message)) take(*order, now);
    if (const auto* stop = std::get_if<hw::EmergencyStopMessage>(&received->message)) take(*stop);
  }
}

void ThrowerMember::know_commander(Stamp now) {
  const std::uint64_t session = link_.peer_session(now);
  if (std::exchange(commander_session_, session) == session || throwing()) return;
  order_serial_ = 0;  // its numbers begin anew
  refused_.clear();
  last_refusal_.clear();
}

// Whoever called a stop takes it back, nobody else.
void ThrowerMember::take(const hw::EmergencyStopMessage& stop) {
  if (stop.pressed) {
    stops_[stop.origin.robot] = stop.reason;
  } else {
    stops_.erase(stop.origin.robot);
  }
}

std::string ThrowerMember::called_stop() const {
  if (stops_.empty()) return {};
  const auto& [robot, reason] = *stops_.begin();
  return "emergency stop by '" + robot + "': " + reason;
}

void ThrowerMember::take(const hw::ShotOrderMessage& order, Stamp now) {
  ++orders_;
  const auto verdict = gate_.judge(order, link_.local(order.origin.stamp, now), now);
  last_refusal_ = verdict.reason;
  if (verdict.accepted) last_refusal_ = throwing() ? "another order is being thrown" : not_ready();
  if (last_refusal_.empty()) return begin(order, now);
  next_state_ = now;
  // What becomes of our commander's own order is not overwritten by anybody else's, nor by one that comes too much.
  const bool answers_commander = order.origin.robot == "skip" && order.origin.session == commander_session_;
  if (throwing() || !answers_commander) return;
  refused_ = last_refusal_;
  order_serial_ = order.origin.serial;
}

void ThrowerMember::begin(const hw::ShotOrderMessage& order, Stamp now) {
  order_serial_ = order.origin.serial;
  refused_.clear();
  seer_ = seers_();
  loop_ = std::make_unique<ThrowerLoop>(devices_, ThrowerEyes(*seer_, rig_.looks),
                                        servo::Thrower(rig_.thrower, order_of(order, rig_.thrower.release), now),
                                        servo::Supervisor(rig_.thrower));
  loop_->arm(now);
  began_ = now;
  over_ = release_told_ = false;
}

std::string ThrowerMember::not_ready() const {
  using hw::DrivePhase;
  if (std::string stop = called_stop(); !stop.empty()) return stop;
  const std::array errors{devices_.drive.state().error, devices_.gripper.state().error, devices_.arm.state().error,
                          devices_.gyro.state().error};
  for (const auto& error : errors)
    if (error) return error->device + ": " + error->what;
  const DrivePhase drive = devices_.drive.state().phase;
  if (drive != DrivePhase::ready && drive != DrivePhase::stopped) return "the drives are not ready";
  if (devices_.gripper.state().jaws != hw::JawState::holding) return "no stone is held";
  if (!devices_.operator_switch.state().held) return "the operator's switch is not held";
  return {};
}

void ThrowerMember::load() {
  clear(devices_.drive, devices_.drive.state().error);
  clear(devices_.gripper, devices_.gripper.state().error);
  clear(devices_.arm, devices_.arm.state().error);
  clear(devices_.gyro, devices_.gyro.state().error);
  clear(devices_.near_camera, devices_.near_camera.error());
  clear(devices_.low_camera, devices_.low_camera.error());
  stops_.clear();
  loading_ = true;
}

void ThrowerMember::stand_by(Stamp now) {
  devices_.drive.step(now);
  devices_.gripper.step(now);
  devices_.arm.step(now);
  const hw::DriveState drive = devices_.drive.state();
  devices_.gyro.at_rest(drive.stamp != Stamp{} && !drive.error &&
                        std::abs(drive.measured.left_radps) < standing_radps &&
                        std::abs(drive.measured.right_radps) < standing_radps);
  devices_.gyro.step(now);
  devices_.operator_switch.step(now);
  const hw::GripperState gripper = devices_.gripper.state();
  if (!loading_ || gripper.error || gripper.jaws == hw::JawState::unknown) return;
  if (gripper.jaws != hw::JawState::holding) devices_.gripper.grip();
  loading_ = false;
}

// The wheels' power is taken away as soon as nothing is to be driven any more: a drive that waits for set-points
// would call their end a fault.
void ThrowerMember::run(Stamp now, Duration dt) {
  const std::string missing = link_.missing(now);
  if (!stops_.empty()) loop_->stop(called_stop());
  if (!missing.empty() && !loop_->thrower().released()) loop_->stop("link: " + missing);
  loop_->step(now, dt);
  if (loop_->thrower().diagnosis().freed && !release_told_) tell_release(now);
  if (!loop_->thrower().finished()) return;
  over_ = true;
  devices_.drive.quick_stop();
}

void ThrowerMember::tell_release(Stamp now) {
  const servo::FreedStone& freed = *loop_->thrower().diagnosis().freed;
  hw::ReleaseMessage release;
  release.order_serial = order_serial_;
  release.hog_distance_m = vision::rules::tee_to_hog_m - freed.y_m;
  release.lateral_m = freed.x_m;
  release.speed_mps = freed.speed_mps;
  release.heading_rad = freed.heading_rad;
  release.spin_radps = freed.spin_radps;
  link_.send(release, freed.stamp);
  release_told_ = true;
  next_state_ = now;
}

hw::ThrowerPhase ThrowerMember::phase() const {
  using servo::ThrowerState;
  const bool refused = !refused_.empty();
  if (!loop_ || (over_ && refused)) return refused ? hw::ThrowerPhase::stopped : hw::ThrowerPhase::idle;
  if (!over_) {
    const ThrowerState state = loop_->thrower().state();
    if (state < ThrowerState::run) return hw::ThrowerPhase::aligning;
    if (loop_->thrower().abort_reason() && !loop_->thrower().released()) return hw::ThrowerPhase::stopped;
    return state < ThrowerState::brake ? hw::ThrowerPhase::running : hw::ThrowerPhase::released;
  }
  if (!loop_->device_errors().empty()) return hw::ThrowerPhase::fault;
  return loop_->thrower().abort_reason() ? hw::ThrowerPhase::stopped : hw::ThrowerPhase::idle;
}

// When something of it changes, and now and then.
void ThrowerMember::tell(Stamp now) {
  hw::ThrowerStateMessage state;
  state.phase = phase();
  state.armed = devices_.operator_switch.state().held;
  state.order_serial = order_serial_;
  state.reason = refused_;
  if (refused_.empty() && loop_) state.reason = loop_->thrower().abort_reason().value_or("");
  if (state.reason.empty()) state.reason = last_refusal_;
  const bool changed = state.phase != told_.phase || state.order_serial != told_.order_serial ||
                       state.armed != told_.armed || state.reason != told_.reason;
  if (!changed && now < next_state_) return;
  next_state_ = now + state_period;
  told_ = state;
  link_.send(state, now);
}

}  // namespace hogline
