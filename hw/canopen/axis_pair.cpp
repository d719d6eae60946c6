#include "hw/canopen/axis_pair.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/nmt.hpp"

namespace hogline::hw {
namespace {

// Ten times what two nodes and a busy neighbour can send in a control period at 1 Mbit/s.
constexpr int max_frames_per_step = 512;

std::string late(const char* what, Duration age) {
  char text[96];
  std::snprintf(text, sizeof text, "%s for %.1f ms", what, seconds(age) * 1e3);
  return text;
}

}  // namespace

AxisPair::AxisPair(CanBus& bus, AxisPairConfig config, std::array<DrivenAxis*, 2> axes)
    : bus_(bus), config_(std::move(config)), axes_(axes) {}

// ---- what the owner asks ----

void AxisPair::enable() {
  const DrivePhase now_in = phase();
  if (now_in == DrivePhase::ready || now_in == DrivePhase::stopped) enable_requested_ = true;
}

void AxisPair::quick_stop() {
  stop_requested_ = true;
  enable_requested_ = false;
}

void AxisPair::rearm() {
  if (!error_ || activity_ != Activity::stopped) return;
  error_.reset();
  activity_ = Activity::booting;
  boot_requested_ = true;
}

// ---- listening ----

void AxisPair::listen(Stamp now) {
  watch_own_rhythm(now);
  receive(now);
  watch_bus(now);
  step_axes(now);
  last_step_ = now;
}

void AxisPair::watch_own_rhythm(Stamp now) {
  const bool moving = activity_ == Activity::enabling || activity_ == Activity::enabled;
  if (!moving || !last_step_ || now - *last_step_ <= config_.timing.command_age_limit) return;
  fail(DeviceErrorKind::timeout, config_.name, late("the control loop did not run", now - *last_step_), now);
}

void AxisPair::receive(Stamp now) {
  for (int count = 0; count < max_frames_per_step; ++count) {
    const std::optional<StampedCanFrame> received = bus_.receive();
    if (!received) return;
    watch_for_other_masters(received->frame, now);
    for (DrivenAxis* axis : axes_) axis->on_frame(*received, now);
  }
  fail(DeviceErrorKind::protocol, "CAN bus", "flooded: more frames in one step than the bus can carry", now);
}

void AxisPair::watch_for_other_masters(const CanFrame& frame, Stamp now) {
  if (!is_canopen_frame(frame)) return;
  const auto commands = [&frame](std::uint8_t node) {
    const bool nmt = frame.id == nmt_cob_id && frame.length == 2 && (frame.data[1] == 0 || frame.data[1] == node);
    return nmt || frame.id == rpdo_cob_id(1, node) || frame.id == rpdo_cob_id(2, node);
  };
  const bool conducts = (config_.duties.heartbeat && frame.id == heartbeat_cob_id(config_.master_node)) ||
                        (config_.duties.sync && frame.id == sync_cob_id);
  if (conducts || commands(axes_[0]->node().id()) || commands(axes_[1]->node().id())) {
    fail(DeviceErrorKind::protocol, "CAN bus", "another master commands our drives", now);
  }
}

void AxisPair::watch_bus(Stamp now) {
  if (!bus_.up()) {
    fail(DeviceErrorKind::disconnected, "CAN bus", "bus off, link down or adapter gone", now);
  } else if (bus_.error_passive()) {
    fail(DeviceErrorKind::disconnected, "CAN bus", "error passive: check the wiring and the terminations", now);
  } else if (blocked_since_ && now - *blocked_since_ > config_.timing.command_age_limit) {
    fail(DeviceErrorKind::disconnected, "CAN bus", "no room for commands; nobody acknowledges or the bus is full", now);
  }
}

void AxisPair::step_axes(Stamp now) {
  if (std::exchange(boot_requested_, false)) {
    enter(Activity::booting, now);
    next_heartbeat_.reset();
    blocked_since_.reset();
    for (DrivenAxis* axis : axes_) axis->boot(now);
  }
  for (DrivenAxis* axis : axes_) {
    axis->step(now);
    if (const auto& error = axis->node().error()) fail(error->kind, error->device, error->what, error->since);
  }
}

template <typename Predicate>
bool AxisPair::both(Predicate holds) const {
  return holds(axes_[0]->node()) && holds(axes_[1]->node());
}

void AxisPair::advance(Stamp now) {
  const bool enable = std::exchange(enable_requested_, false);
  const bool quick_stop = std::exchange(stop_requested_, false);
  if (error_ || quick_stop) return advance_to_stop(error_.has_value(), now);

  switch (activity_) {
    case Activity::booting:
      if (both([](const DriveNode& node) { return node.operational(); })) enter(Activity::ready, now);
      return;
    case Activity::ready:
    case Activity::stopped:
      if (enable) enter(Activity::enabling, now);
      return;
    case Activity::enabling:
      if (both([](const DriveNode& node) { return node.state() == Cia402State::operation_enabled; })) {
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

void AxisPair::advance_to_stop(bool faulted, Stamp now) {
  const Duration elapsed = now - activity_since_;
  switch (activity_) {
    case Activity::booting:
    case Activity::ready:
      if (!faulted) return;  // a quick stop has nothing to stop
      for (DrivenAxis* axis : axes_) axis->node().abandon_boot();
      return enter(Activity::braking, now);
    case Activity::enabling:
    case Activity::enabled:
      return enter(Activity::braking, now);
    case Activity::braking:
      if (both([now](const DriveNode& node) { return node.at_rest(now); })) return enter(Activity::powering_off, now);
      if (elapsed <= config_.stop_deadline) return;
      fail(DeviceErrorKind::refused, config_.name, "does not come to rest by its quick stop; power is taken away", now);
      return enter(Activity::powering_off, now);
    case Activity::powering_off:
      if (both([now](const DriveNode& node) { return node.without_power(now); })) return enter(Activity::stopped, now);
      if (elapsed <= config_.timing.state_timeout) return;
      fail(DeviceErrorKind::refused, config_.name, "does not confirm that its power is off", now);
      return enter(Activity::stopped, now);
    case Activity::stopped:
      return;
  }
}

// ---- sending ----

void AxisPair::send(std::span<const CanFrame> commands, Stamp now) {
  if (!bus_.up()) return discard_outgoing();
  if (config_.duties.heartbeat && (!next_heartbeat_ || now >= *next_heartbeat_)) {
    bus_.send(heartbeat_frame(config_.master_node, NmtState::operational));
    next_heartbeat_ = now + config_.timing.heartbeat_period;
  }
  for (DrivenAxis* axis : axes_) {
    while (const std::optional<CanFrame> frame = axis->node().take_frame()) bus_.send(*frame);
  }
  send_commands(commands, now);
  if (config_.duties.sync) bus_.send(sync_frame());
}

void AxisPair::discard_outgoing() {
  for (DrivenAxis* axis : axes_) {
    while (axis->node().take_frame()) continue;
  }
}

void AxisPair::send_commands(std::span<const CanFrame> commands, Stamp now) {
  if (commands.empty()) return;
  bool blocked = false;
  for (const CanFrame& command : commands) blocked |= bus_.send(command) != CanSendResult::sent;
  if (!blocked) {
    blocked_since_.reset();
  } else if (!blocked_since_) {
    blocked_since_ = now;
  }
}

// ---- state ----

void AxisPair::enter(Activity activity, Stamp now) {
  activity_ = activity;
  activity_since_ = now;
}

void AxisPair::fail(DeviceErrorKind kind, std::string device, std::string what, Stamp now) {
  enable_requested_ = false;
  if (!error_) error_ = DeviceError{kind, std::move(device), std::move(what), now};
}

Cia402Goal AxisPair::goal() const {
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

DrivePhase AxisPair::phase() const {
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

Stamp AxisPair::feedback_stamp() const {
  const auto first = axes_[0]->node().feedback_stamp();
  const auto second = axes_[1]->node().feedback_stamp();
  return first && second ? std::min(*first, *second) : Stamp{};
}

}  // namespace hogline::hw
