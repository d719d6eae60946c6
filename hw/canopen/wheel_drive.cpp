#include "hw/canopen/wheel_drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/wheel_pdos.hpp"

namespace hogline::hw {
namespace {

std::string missing_for(const char* what, Duration age) {
  char text[96];
  std::snprintf(text, sizeof text, "no %s for %.0f ms", what, seconds(age) * 1e3);
  return text;
}

std::string error_code_text(std::uint16_t code) {
  char text[96];
  std::snprintf(text, sizeof text, "error code %04X (%s)", unsigned{code}, emergency_meaning(code));
  return text;
}

}  // namespace

WheelDrive::WheelDrive(const WheelConfig& wheel, const TwoWheelDriveConfig& config)
    : wheel_(wheel),
      timing_(config.timing),
      standstill_radps_(config.plausibility.standstill_radps),
      label_(wheel.name + " (node " + std::to_string(wheel.node) + ")"),
      units_(wheel),
      boot_(wheel, config.timing, config.master_node),
      check_(config.plausibility, wheel.max_speed_radps) {}

// ---- boot ----

void WheelDrive::boot(Stamp now) {
  started_ = false;
  start_frame_.reset();
  heartbeat_stamp_.reset();
  nmt_state_ = NmtState::unknown;
  last_emergency_.reset();
  stepper_.restart();
  state_ = Cia402State::unknown;
  was_enabled_ = false;
  status_stamp_.reset();
  position_stamp_.reset();
  speed_radps_ = 0.0;
  check_.restart();
  error_.reset();
  boot_.start(now);
  enter(Stage::booting, now);
}

void WheelDrive::enter(Stage stage, Stamp now) {
  stage_ = stage;
  stage_since_ = now;
  if (stage != Stage::starting) return;
  start_frame_ = nmt_frame(NmtCommand::start, wheel_.node);
  heartbeat_stamp_.reset();
  status_stamp_.reset();
  position_stamp_.reset();
  started_ = true;
}

void WheelDrive::fail(DeviceErrorKind kind, std::string what, Stamp now) {
  if (error_) return;
  error_ = DeviceError{kind, label_, std::move(what), now};
  halt();
}

void WheelDrive::halt() {
  stage_ = Stage::failed;
  boot_.cancel();
  start_frame_.reset();
}

void WheelDrive::abandon_boot() {
  if (stage_ != Stage::operational) halt();
}

void WheelDrive::step(Stamp now) {
  switch (stage_) {
    case Stage::booting:
      advance_boot(now);
      break;
    case Stage::starting:
      await_start(now);
      break;
    case Stage::clearing_fault:
      await_cleared_fault(now);
      break;
    case Stage::operational:
      supervise_communication(now);
      supervise_drive(now);
      supervise_transition(now);
      break;
    case Stage::idle:
    case Stage::failed:
      break;
  }
  check_stage_deadline(now);
}

void WheelDrive::advance_boot(Stamp now) {
  boot_.step(now);
  if (const auto& failure = boot_.failure()) return fail(failure->kind, failure->what, now);
  if (boot_.done()) enter(Stage::starting, now);
}

void WheelDrive::await_start(Stamp now) {
  if (nmt_state_ == NmtState::operational && heartbeat_stamp_ && feedback_fresh(now)) enter(Stage::clearing_fault, now);
}

void WheelDrive::await_cleared_fault(Stamp now) {
  supervise_communication(now);
  if (stage_ == Stage::clearing_fault && state_ == Cia402State::switch_on_disabled) {
    check_.restart();
    enter(Stage::operational, now);
  }
}

void WheelDrive::check_stage_deadline(Stamp now) {
  if (stage_ != Stage::starting && stage_ != Stage::clearing_fault) return;
  if (now - stage_since_ <= timing_.boot_timeout) return;
  const std::string cry = last_emergency_ && last_emergency_->code != 0 ? "; last " + describe(*last_emergency_) : "";
  if (stage_ == Stage::starting) {
    fail(DeviceErrorKind::timeout, "no heartbeat in operational with both TPDOs after NMT start" + cry, now);
  } else {
    fail(DeviceErrorKind::refused, std::string{"does not reach switch on disabled: "} + to_string(state_) + cry, now);
  }
}

// ---- frames ----

void WheelDrive::on_frame(const StampedCanFrame& received, Stamp now) {
  const CanFrame& frame = received.frame;
  if (stage_ == Stage::idle || !is_canopen_frame(frame)) return;
  if (frame.id == tpdo_cob_id(1, wheel_.node)) return on_status(received, now);
  if (frame.id == tpdo_cob_id(2, wheel_.node)) return on_position(received, now);
  if (frame.id == sdo_response_cob_id(wheel_.node)) return boot_.on_sdo(frame, now);
  if (frame.id == heartbeat_cob_id(wheel_.node)) {
    const std::optional<Heartbeat> heartbeat = decode_heartbeat(frame);
    if (heartbeat) on_heartbeat(heartbeat->state, received.stamp, now);
    return;
  }
  if (frame.id == emergency_cob_id(wheel_.node)) {
    if (const std::optional<Emergency> emergency = decode_emergency(frame)) on_emergency(*emergency, now);
  }
}

void WheelDrive::on_heartbeat(NmtState state, Stamp stamp, Stamp now) {
  nmt_state_ = state;
  heartbeat_stamp_ = stamp;
  if (state != NmtState::boot_up) return;
  const bool expected = stage_ == Stage::booting && boot_.on_boot_up(now);
  if (!expected) fail(DeviceErrorKind::device_fault, "unexpected boot-up: the drive was reset; check its supply", now);
}

void WheelDrive::on_emergency(const Emergency& emergency, Stamp now) {
  last_emergency_ = emergency;
  if (stage_ == Stage::operational && emergency.code != 0) {
    fail(DeviceErrorKind::device_fault, describe(emergency), now);
  }
}

void WheelDrive::on_status(const StampedCanFrame& received, Stamp now) {
  if (!started_) return;
  const std::optional<WheelStatusPdo> status = decode_wheel_status(received.frame);
  if (!status) return fail(DeviceErrorKind::protocol, "TPDO1 of wrong length; check its mapping", now);
  status_stamp_ = received.stamp;
  state_ = decode_statusword(status->statusword);
  mode_ = status->mode;
  speed_radps_ = units_.radps(status->velocity);
}

void WheelDrive::on_position(const StampedCanFrame& received, Stamp now) {
  if (!started_) return;
  const std::optional<WheelPositionPdo> feedback = decode_wheel_position(received.frame);
  if (!feedback) return fail(DeviceErrorKind::protocol, "TPDO2 of wrong length; check its mapping", now);
  if (position_stamp_ && received.stamp > *position_stamp_) {
    check_.on_feedback(units_.travel_rad(position_, feedback->position), speed_radps_,
                       received.stamp - *position_stamp_);
  }
  position_stamp_ = received.stamp;
  position_ = feedback->position;
  error_code_ = feedback->error_code;
}

std::optional<CanFrame> WheelDrive::take_frame() {
  if (start_frame_) return std::exchange(start_frame_, std::nullopt);
  return boot_.take_frame();
}

// ---- supervision ----

std::optional<Stamp> WheelDrive::feedback_stamp() const {
  if (!status_stamp_ || !position_stamp_) return std::nullopt;
  return std::min(*status_stamp_, *position_stamp_);
}

bool WheelDrive::feedback_fresh(Stamp now) const {
  const std::optional<Stamp> stamp = feedback_stamp();
  return stamp && now - *stamp <= timing_.feedback_timeout;
}

bool WheelDrive::at_rest(Stamp now) const {
  if (!started_) return true;
  if (!feedback_fresh(now) || std::abs(speed_radps_) > standstill_radps_) return false;
  return state_ != Cia402State::operation_enabled && state_ != Cia402State::fault_reaction_active;
}

bool WheelDrive::without_power(Stamp now) const {
  if (!started_) return true;
  return feedback_fresh(now) && (state_ == Cia402State::switch_on_disabled || state_ == Cia402State::fault);
}

void WheelDrive::supervise_communication(Stamp now) {
  if (heartbeat_stamp_ && now - *heartbeat_stamp_ > timing_.heartbeat_timeout) {
    return fail(DeviceErrorKind::timeout, missing_for("heartbeat", now - *heartbeat_stamp_), now);
  }
  if (nmt_state_ != NmtState::operational) {
    return fail(DeviceErrorKind::device_fault, std::string{"left NMT operational: "} + to_string(nmt_state_), now);
  }
  if (!feedback_fresh(now)) {
    fail(DeviceErrorKind::timeout, missing_for("feedback (TPDO)", now - *feedback_stamp()), now);
  }
}

void WheelDrive::supervise_drive(Stamp now) {
  if (state_ == Cia402State::unknown) {
    return fail(DeviceErrorKind::protocol, "statusword outside the standard's table", now);
  }
  if (state_ == Cia402State::fault || state_ == Cia402State::fault_reaction_active) {
    return fail(DeviceErrorKind::device_fault, std::string{to_string(state_)} + ", " + error_code_text(error_code_),
                now);
  }
  if (mode_ != cyclic_sync_velocity_mode) {
    return fail(DeviceErrorKind::device_fault, "left cyclic synchronous velocity: mode " + std::to_string(mode_), now);
  }
  if (was_enabled_ && state_ != Cia402State::operation_enabled) {
    return fail(DeviceErrorKind::device_fault, std::string{"left operation enabled by itself: "} + to_string(state_),
                now);
  }
  if (was_enabled_) {
    check_.on_following(target_radps_, speed_radps_, now);
  } else {
    check_.on_not_following();
  }
  if (check_.problem()) fail(DeviceErrorKind::implausible, *check_.problem(), now);
}

void WheelDrive::supervise_transition(Stamp now) {
  const auto overdue = stepper_.overdue(now, timing_.quick_stop_timeout, timing_.state_timeout);
  if (!overdue) return;
  fail(DeviceErrorKind::refused,
       "transition " + std::to_string(overdue->number) + " to " + to_string(overdue->to) + " does not happen: still " +
           to_string(state_),
       now);
}

// ---- commands ----

std::optional<CanFrame> WheelDrive::command(Cia402Goal goal, double target_radps, Stamp now) {
  if (!started_) return std::nullopt;
  switch (stage_) {
    case Stage::operational:
      break;
    case Stage::clearing_fault:
      goal = Cia402Goal::reset;
      break;
    case Stage::failed:
      if (goal != Cia402Goal::off) goal = Cia402Goal::stopped;
      break;
    default:
      goal = Cia402Goal::off;
      break;
  }
  const Cia402Command controlword = stepper_.step(state_, goal, now);
  was_enabled_ = goal == Cia402Goal::enabled && (was_enabled_ || state_ == Cia402State::operation_enabled);
  target_radps_ = was_enabled_ ? target_radps : 0.0;
  return encode(WheelCommandPdo{controlword, units_.velocity(target_radps_)}, wheel_.node);
}

}  // namespace hogline::hw
