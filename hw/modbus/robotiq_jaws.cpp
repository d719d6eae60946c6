#include "hw/modbus/robotiq_jaws.hpp"

namespace hogline::hw {

namespace {

constexpr robotiq::Command activate{.activate = true};
// Open as fast as the jaws can: what counts is that the stone is let go at once and evenly.
constexpr robotiq::Command open_fast{
    .activate = true, .go_to = true, .position = robotiq::open_position, .speed = 255, .force = 255};
// Fault 09 says that nobody talked to the jaws for a second: the answer that carries it is the end of that silence.
constexpr std::uint8_t silence_fault = 0x09;
constexpr std::uint8_t midway = 128;

}  // namespace

RobotiqJaws::RobotiqJaws(const JawsConfig& config) : config_(config), latch_("jaws", config.silence_limit) {}

void RobotiqJaws::grip() {
  if (latch_.error() || goal_ == Goal::grip) return;
  goal_ = Goal::grip;
  order_waits_ = true;
}

void RobotiqJaws::release() {
  if (latch_.error() || goal_ == Goal::release) return;
  goal_ = Goal::release;
  order_waits_ = true;
}

void RobotiqJaws::rearm() {
  latch_.rearm();
  goal_ = Goal::none;
  order_waits_ = false;
  known_ = false;
  may_hold_ = false;
  ordered_at_.reset();
  activating_since_.reset();
  expected_echo_.reset();
}

void RobotiqJaws::step(ModbusSession& session, Stamp now) {
  if (order_waits_ && known_ && !latch_.error()) send_order(session, now);
  if (latch_.error()) order_waits_ = false;

  const bool seen = opening_since_ && (freed_at_ || jaws_ == JawState::open);
  const bool watching_release = goal_ == Goal::release && !seen && !latch_.error();
  if (next_poll_ && now < *next_poll_ && !watching_release) return;
  next_poll_ = now + config_.poll_period;
  poll(session, now);
}

bool RobotiqJaws::send(ModbusSession& session, const robotiq::Command& command, Stamp now) {
  const auto registers = robotiq::encode(command);
  if (const auto fault = session.write(config_.unit, robotiq::command_address, registers, now)) {
    expected_echo_.reset();  // it may have arrived all the same: the next status tells
    latch_.latch(fault->kind, "an order was not taken: " + fault->what, now);
    return false;
  }
  expected_echo_ = command.position;
  ordered_at_ = now;
  return true;
}

void RobotiqJaws::send_order(ModbusSession& session, Stamp now) {
  if (goal_ == Goal::grip) return start_grip(session, now);
  order_waits_ = false;
  if (!activated_) return latch_.latch(DeviceErrorKind::refused, "can not open: the jaws are not activated", now);
  opening_since_.reset();
  freed_at_.reset();
  last_travel_ = 0;
  last_travel_stamp_ = now;
  send(session, open_fast, now);
}

void RobotiqJaws::start_grip(ModbusSession& session, Stamp now) {
  if (activated_) {
    order_waits_ = false;
    opening_since_.reset();
    freed_at_.reset();
    if (jaws_ == JawState::holding) return;
    send(session,
         {.activate = true,
          .go_to = true,
          .position = robotiq::closed_position,
          .speed = config_.close_speed,
          .force = config_.close_force},
         now);
    may_hold_ = true;
  } else if (may_hold_) {
    latch_.latch(DeviceErrorKind::refused, "activation moves the fingers, and a stone may be held: take it out, re-arm",
                 now);
  } else if (!activating_since_) {
    if (send(session, activate, now)) activating_since_ = now;
  }
}

void RobotiqJaws::poll(ModbusSession& session, Stamp now) {
  robotiq::Registers registers{};
  if (const auto fault = session.read_input(config_.unit, robotiq::status_address, registers, now)) {
    return latch_.poll_failed(*fault, now);
  }
  latch_.poll_succeeded(now);
  const auto status = robotiq::decode(registers);
  if (!belongs_to_order(status, now)) return;
  check_faults(status, now);
  check_activation(status, now);
  take_object(status, now);
  take_travel(status, now);
  known_ = true;
  stamp_ = now;
}

bool RobotiqJaws::belongs_to_order(const robotiq::Status& status, Stamp now) {
  if (!expected_echo_) expected_echo_ = status.position_echo;
  if (status.position_echo == *expected_echo_) {
    ordered_at_.reset();
    return true;
  }
  if (!ordered_at_) {
    latch_.latch(DeviceErrorKind::protocol, "the position echo changed without an order: is there another master?",
                 now);
  } else if (now - *ordered_at_ > config_.echo_deadline) {
    latch_.latch(DeviceErrorKind::protocol, "the position echo does not answer the order", now);
  }
  return false;
}

void RobotiqJaws::check_faults(const robotiq::Status& status, Stamp now) {
  if (status.fault == 0 || (status.fault == silence_fault && !known_)) return;
  latch_.latch(DeviceErrorKind::device_fault, robotiq::describe_fault(status.fault), now);
}

void RobotiqJaws::check_activation(const robotiq::Status& status, Stamp now) {
  const bool active = status.activated && status.activation == robotiq::Activation::active;
  if (activated_ && !active) {
    latch_.latch(DeviceErrorKind::device_fault, "the jaws lost their activation: did they lose power?", now);
  }
  activated_ = active;
  if (active) {
    activating_since_.reset();
  } else if (activating_since_ && now - *activating_since_ > config_.activation_deadline) {
    activating_since_.reset();
    latch_.latch(DeviceErrorKind::timeout, "activation did not end", now);
  }
}

void RobotiqJaws::take_object(const robotiq::Status& status, Stamp now) {
  const bool opening = status.position_echo < midway;
  const auto before = jaws_;
  if (!activated_) {
    jaws_ = JawState::unknown;
    return;
  }
  switch (status.object) {
    case robotiq::Object::moving:
      jaws_ = JawState::moving;
      break;
    case robotiq::Object::contact_opening:
      jaws_ = JawState::moving;
      latch_.latch(DeviceErrorKind::device_fault, "the fingers are blocked while opening", now);
      break;
    case robotiq::Object::contact_closing:
      jaws_ = opening ? JawState::moving : JawState::holding;
      break;
    case robotiq::Object::at_position:
      jaws_ = opening ? JawState::open : JawState::closed_empty;
      break;
  }
  if (before == JawState::holding && jaws_ != JawState::holding && !opening) {
    latch_.latch(DeviceErrorKind::device_fault, "closed jaws lost their grip of the stone", now);
  }
  const bool parting = opening && (jaws_ == JawState::open || status.object == robotiq::Object::moving);
  if (parting && !opening_since_ && goal_ == Goal::release) opening_since_ = now;
  if (jaws_ == JawState::holding) may_hold_ = true;
  if (jaws_ == JawState::open || jaws_ == JawState::closed_empty) may_hold_ = false;
}

void RobotiqJaws::take_travel(const robotiq::Status& status, Stamp now) {
  if (jaws_ == JawState::holding) held_position_ = status.position;
  const bool opening = goal_ == Goal::release && status.position_echo < midway;
  if (!opening || !held_position_ || freed_at_) return;
  const int travel = *held_position_ - status.position;
  if (travel >= config_.freeing_travel) {
    const double part = static_cast<double>(config_.freeing_travel - last_travel_) / (travel - last_travel_);
    freed_at_ = last_travel_stamp_ + from_seconds(part * seconds(now - last_travel_stamp_));
  }
  last_travel_ = travel;
  last_travel_stamp_ = now;
}

}  // namespace hogline::hw
