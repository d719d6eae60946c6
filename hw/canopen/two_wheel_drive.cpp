#include "hw/canopen/two_wheel_drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/nmt.hpp"

namespace hogline::hw {
namespace {

// Ten times what two nodes and a busy neighbour can send in a control period at 1 Mbit/s.
constexpr int max_frames_per_step = 512;

const TwoWheelDriveConfig& checked(const TwoWheelDriveConfig& config) {
  if (const auto error = config_error(config)) throw std::invalid_argument("drive: " + *error);
  return config;
}

std::string late(const char* what, Duration age) {
  char text[96];
  std::snprintf(text, sizeof text, "%s for %.1f ms", what, seconds(age) * 1e3);
  return text;
}

bool within(double speed_radps, double max_radps) {
  return std::isfinite(speed_radps) && std::abs(speed_radps) <= max_radps;
}

}  // namespace

TwoWheelDrive::TwoWheelDrive(CanBus& bus, const TwoWheelDriveConfig& config)
    : bus_(bus),
      config_(checked(config)),
      wheels_{WheelDrive{config_.left, config_}, WheelDrive{config_.right, config_}} {}

void TwoWheelDrive::step(Stamp now) {
  watch_own_rhythm(now);
  receive(now);
  watch_bus(now);
  step_wheels(now);
  advance(now);
  send(now);
  last_step_ = now;
}

// ---- what the caller asks ----

void TwoWheelDrive::enable() {
  const DrivePhase now_in = phase();
  if (now_in == DrivePhase::ready || now_in == DrivePhase::stopped) enable_requested_ = true;
}

void TwoWheelDrive::command(const WheelSpeeds& speeds, Stamp now) {
  if (!within(speeds.left_radps, config_.left.max_speed_radps) ||
      !within(speeds.right_radps, config_.right.max_speed_radps)) {
    char text[96];
    std::snprintf(text, sizeof text, "set-point %.3g, %.3g rad/s is not finite or beyond the limit", speeds.left_radps,
                  speeds.right_radps);
    return fail(DeviceErrorKind::implausible, "drive", text, now);
  }
  if (phase() == DrivePhase::enabled && !stop_requested_) pending_ = SetPoint{speeds, now};
}

void TwoWheelDrive::quick_stop() {
  stop_requested_ = true;
  enable_requested_ = false;
  pending_.reset();
}

void TwoWheelDrive::rearm() {
  if (!error_ || activity_ != Activity::stopped) return;
  error_.reset();
  activity_ = Activity::booting;
  boot_requested_ = true;
}

// ---- one step ----

void TwoWheelDrive::watch_own_rhythm(Stamp now) {
  const bool moving = activity_ == Activity::enabling || activity_ == Activity::enabled;
  if (!moving || !last_step_ || now - *last_step_ <= config_.timing.command_age_limit) return;
  fail(DeviceErrorKind::timeout, "drive", late("the control loop did not run", now - *last_step_), now);
}

void TwoWheelDrive::receive(Stamp now) {
  for (int count = 0; count < max_frames_per_step; ++count) {
    const std::optional<StampedCanFrame> received = bus_.receive();
    if (!received) return;
    watch_for_other_masters(received->frame, now);
    for (WheelDrive& wheel : wheels_) wheel.on_frame(*received, now);
  }
  fail(DeviceErrorKind::protocol, "CAN bus", "flooded: more frames in one step than the bus can carry", now);
}

void TwoWheelDrive::watch_for_other_masters(const CanFrame& frame, Stamp now) {
  if (!is_canopen_frame(frame)) return;
  const auto commands = [&frame](std::uint8_t node) {
    const bool nmt = frame.id == nmt_cob_id && frame.length == 2 && (frame.data[1] == 0 || frame.data[1] == node);
    return nmt || frame.id == rpdo_cob_id(1, node);
  };
  if (commands(config_.left.node) || commands(config_.right.node) ||
      frame.id == heartbeat_cob_id(config_.master_node)) {
    fail(DeviceErrorKind::protocol, "CAN bus", "another master commands our drives", now);
  }
}

void TwoWheelDrive::watch_bus(Stamp now) {
  if (!bus_.up()) {
    fail(DeviceErrorKind::disconnected, "CAN bus", "bus off, link down or adapter gone", now);
  } else if (blocked_since_ && now - *blocked_since_ > config_.timing.command_age_limit) {
    fail(DeviceErrorKind::disconnected, "CAN bus", "no room for commands; nobody acknowledges or the bus is full", now);
  }
}

void TwoWheelDrive::step_wheels(Stamp now) {
  if (std::exchange(boot_requested_, false)) {
    enter(Activity::booting, now);
    next_heartbeat_.reset();
    blocked_since_.reset();
    for (WheelDrive& wheel : wheels_) wheel.boot(now);
  }
  for (WheelDrive& wheel : wheels_) {
    wheel.step(now);
    if (const auto& error = wheel.error()) fail(error->kind, error->device, error->what, error->since);
  }
}

template <typename Predicate>
bool TwoWheelDrive::both(Predicate holds) const {
  return holds(wheels_[0]) && holds(wheels_[1]);
}

void TwoWheelDrive::advance(Stamp now) {
  const bool enable = std::exchange(enable_requested_, false);
  const bool quick_stop = std::exchange(stop_requested_, false);
  if (activity_ == Activity::enabled && !quick_stop) expire_command(now);
  if (error_ || quick_stop) return advance_to_stop(error_.has_value(), now);

  switch (activity_) {
    case Activity::booting:
      if (both([](const WheelDrive& wheel) { return wheel.operational(); })) enter(Activity::ready, now);
      return;
    case Activity::ready:
    case Activity::stopped:
      if (enable) enter(Activity::enabling, now);
      return;
    case Activity::enabling:
      if (both([](const WheelDrive& wheel) { return wheel.state() == Cia402State::operation_enabled; })) {
        last_set_point_ = now;
        enter(Activity::enabled, now);
      }
      return;
    case Activity::enabled:
      return;
    case Activity::braking:
    case Activity::powering_off:
      return advance_to_stop(false, now);
  }
}

void TwoWheelDrive::advance_to_stop(bool faulted, Stamp now) {
  const Duration elapsed = now - activity_since_;
  switch (activity_) {
    case Activity::booting:
    case Activity::ready:
      if (!faulted) return;  // a quick stop has nothing to stop
      for (WheelDrive& wheel : wheels_) wheel.abandon_boot();
      return enter(Activity::braking, now);
    case Activity::enabling:
    case Activity::enabled:
      return enter(Activity::braking, now);
    case Activity::braking:
      if (both([now](const WheelDrive& wheel) { return wheel.at_rest(now); }))
        return enter(Activity::powering_off, now);
      if (elapsed <= stop_deadline()) return;
      fail(DeviceErrorKind::refused, "drive", "does not come to rest by its quick stop; power is taken away", now);
      return enter(Activity::powering_off, now);
    case Activity::powering_off:
      if (both([now](const WheelDrive& wheel) { return wheel.without_power(now); }))
        return enter(Activity::stopped, now);
      if (elapsed <= config_.timing.state_timeout) return;
      fail(DeviceErrorKind::refused, "drive", "does not confirm that its power is off", now);
      return enter(Activity::stopped, now);
    case Activity::stopped:
      return;
  }
}

void TwoWheelDrive::expire_command(Stamp now) {
  if (pending_ && now - pending_->stamp > config_.timing.command_age_limit) pending_.reset();
  if (pending_) last_set_point_ = std::max(last_set_point_, pending_->stamp);
  if (now - last_set_point_ > config_.timing.command_age_limit) {
    fail(DeviceErrorKind::timeout, "drive", late("no new set-point", now - last_set_point_), now);
  }
}

// ---- sending ----

void TwoWheelDrive::send(Stamp now) {
  if (!bus_.up()) return discard_outgoing();
  if (!next_heartbeat_ || now >= *next_heartbeat_) {
    bus_.send(heartbeat_frame(config_.master_node, NmtState::operational));
    next_heartbeat_ = now + config_.timing.heartbeat_period;
  }
  for (WheelDrive& wheel : wheels_) {
    while (const std::optional<CanFrame> frame = wheel.take_frame()) bus_.send(*frame);
  }
  send_commands(now);
  bus_.send(sync_frame());
}

void TwoWheelDrive::discard_outgoing() {
  pending_.reset();
  for (WheelDrive& wheel : wheels_) {
    while (wheel.take_frame()) continue;
  }
}

void TwoWheelDrive::send_commands(Stamp now) {
  const std::optional<SetPoint> set_point = std::exchange(pending_, std::nullopt);
  const bool following = activity_ == Activity::enabled;
  if (following && !set_point) return;

  const WheelSpeeds speeds = following ? set_point->speeds : WheelSpeeds{};
  bool blocked = false;
  const std::array targets{speeds.left_radps, speeds.right_radps};
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const std::optional<CanFrame> frame = wheels_[i].command(goal(), targets[i], now);
    if (frame) blocked |= bus_.send(*frame) != CanSendResult::sent;
  }
  if (!blocked) {
    blocked_since_.reset();
  } else if (!blocked_since_) {
    blocked_since_ = now;
  }
}

// ---- state ----

void TwoWheelDrive::enter(Activity activity, Stamp now) {
  activity_ = activity;
  activity_since_ = now;
  if (activity != Activity::enabled) pending_.reset();
}

void TwoWheelDrive::fail(DeviceErrorKind kind, std::string device, std::string what, Stamp now) {
  pending_.reset();
  enable_requested_ = false;
  if (!error_) error_ = DeviceError{kind, std::move(device), std::move(what), now};
}

Cia402Goal TwoWheelDrive::goal() const {
  switch (activity_) {
    case Activity::enabling:
    case Activity::enabled:
      return Cia402Goal::enabled;
    case Activity::braking:
      return Cia402Goal::stopped;
    default:
      return Cia402Goal::off;
  }
}

Duration TwoWheelDrive::stop_deadline() const {
  const double ramp_s = std::max(config_.left.max_speed_radps / config_.left.quick_stop_radps2,
                                 config_.right.max_speed_radps / config_.right.quick_stop_radps2);
  return from_seconds(ramp_s) + config_.timing.stop_margin;
}

DrivePhase TwoWheelDrive::phase() const {
  if (error_) return DrivePhase::faulted;
  switch (activity_) {
    case Activity::booting:
      return DrivePhase::booting;
    case Activity::ready:
      return DrivePhase::ready;
    case Activity::enabling:
      return DrivePhase::enabling;
    case Activity::enabled:
      return DrivePhase::enabled;
    case Activity::braking:
    case Activity::powering_off:
      return DrivePhase::stopping;
    case Activity::stopped:
      return DrivePhase::stopped;
  }
  return DrivePhase::faulted;
}

DriveState TwoWheelDrive::state() const {
  DriveState state{.phase = phase(), .stamp = {}, .measured = {}, .error = error_};
  state.measured = {wheels_[0].speed_radps(), wheels_[1].speed_radps()};
  const auto left = wheels_[0].feedback_stamp();
  const auto right = wheels_[1].feedback_stamp();
  if (left && right) state.stamp = std::min(*left, *right);
  return state;
}

}  // namespace hogline::hw
