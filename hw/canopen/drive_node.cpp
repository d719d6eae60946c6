#include "hw/canopen/drive_node.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/drive_pdos.hpp"

namespace hogline::hw {
namespace {

// One TPDO1 a period of time is right, by the frames' own stamps: when they were read says nothing, for a program that
// is held up reads several at once. A doubled frame now and then is forgiven: this much of a surplus is forgotten each
// period, and at this surplus somebody else sends it too. Frames that were missing may come late and all at once, as
// far as the feedback's timeout allows.
constexpr double forgotten_surplus = 0.1;
constexpr double most_surplus = 4.0;

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

DriveNode::DriveNode(const NodeIdentity& identity, const DriveTiming& timing, std::vector<SdoWrite> setup,
                     std::int8_t mode, double standstill)
    : id_(identity.node),
      timing_(timing),
      standstill_(standstill),
      label_(identity.name + " (node " + std::to_string(identity.node) + ")"),
      boot_(identity, timing, std::move(setup), mode),
      boot_mode_(mode),
      wanted_mode_(mode) {}

// ---- boot ----

void DriveNode::boot(Stamp now) {
  started_ = false;
  nmt_frame_.reset();
  cut_off_.reset();
  heartbeat_stamp_.reset();
  nmt_state_ = NmtState::unknown;
  last_emergency_.reset();
  stepper_.restart();
  state_ = Cia402State::unknown;
  following_ = false;
  wanted_mode_ = boot_mode_;
  mode_confirmed_ = true;
  status_stamp_.reset();
  position_stamp_.reset();
  velocity_ = 0;
  surplus_ = 0.0;
  error_.reset();
  boot_.start(now);
  enter(Stage::booting, now);
}

void DriveNode::enter(Stage stage, Stamp now) {
  stage_ = stage;
  stage_since_ = now;
  if (stage != Stage::starting) return;
  counted_until_ = now;
  nmt_frame_ = nmt_frame(NmtCommand::start, id_);
  heartbeat_stamp_.reset();
  status_stamp_.reset();
  position_stamp_.reset();
  started_ = true;
}

void DriveNode::fail(DeviceErrorKind kind, std::string what, Stamp now) {
  if (error_) return;
  error_ = DeviceError{kind, label_, std::move(what), now};
  halt();
}

void DriveNode::halt() {
  stage_ = Stage::failed;
  boot_.cancel();
  nmt_frame_.reset();
}

void DriveNode::abandon_boot() {
  if (stage_ != Stage::operational) halt();
}

void DriveNode::step(Stamp now) {
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
    case Stage::failed:
      cut_off_if_unseen(now);
      break;
    case Stage::idle:
      break;
  }
  check_stage_deadline(now);
}

void DriveNode::advance_boot(Stamp now) {
  boot_.step(now);
  if (const auto& failure = boot_.failure()) return fail(failure->kind, failure->what, now);
  if (boot_.done()) enter(Stage::starting, now);
}

void DriveNode::await_start(Stamp now) {
  if (nmt_state_ == NmtState::operational && heartbeat_stamp_ && feedback_fresh(now)) enter(Stage::clearing_fault, now);
}

void DriveNode::await_cleared_fault(Stamp now) {
  supervise_communication(now);
  if (stage_ == Stage::clearing_fault && state_ == Cia402State::switch_on_disabled) {
    surplus_ = std::min(surplus_, 0.0);
    enter(Stage::operational, now);
  }
}

void DriveNode::check_stage_deadline(Stamp now) {
  if (stage_ != Stage::starting && stage_ != Stage::clearing_fault) return;
  if (now - stage_since_ <= timing_.boot_timeout) return;
  const std::string cry = last_emergency_ && last_emergency_->code != 0 ? "; last " + describe(*last_emergency_) : "";
  if (stage_ == Stage::starting) {
    fail(DeviceErrorKind::timeout, "no heartbeat in operational with both TPDOs after NMT start" + cry, now);
  } else {
    fail(DeviceErrorKind::refused, std::string{"does not reach switch on disabled: "} + to_string(state_) + cry, now);
  }
}

// Its RPDOs act on the SYNC. A drive that gets the one and not the other goes on with its last set-point, fed by our
// quick stops, and its feedback is silent. NMT stop needs no SYNC, and for the drive is a lost connection: it brakes.
void DriveNode::cut_off_if_unseen(Stamp now) {
  if (!started_ || feedback_fresh(now)) return;
  const Stamp failed_since = error_ ? error_->since : stage_since_;
  const Duration waited = now - cut_off_.value_or(failed_since);
  if (waited <= (cut_off_ ? timing_.heartbeat_period : timing_.quick_stop_timeout)) return;
  nmt_frame_ = nmt_frame(NmtCommand::stop, id_);
  cut_off_ = now;
}

// ---- frames ----

std::optional<DriveNode::Travel> DriveNode::on_frame(const StampedCanFrame& received, Stamp now) {
  const CanFrame& frame = received.frame;
  if (stage_ == Stage::idle || !is_canopen_frame(frame)) return std::nullopt;
  if (frame.id == tpdo_cob_id(2, id_)) return on_position(received, now);
  if (frame.id == tpdo_cob_id(1, id_)) {
    on_status(received, now);
  } else if (frame.id == sdo_response_cob_id(id_)) {
    boot_.on_sdo(frame, now);
  } else if (frame.id == heartbeat_cob_id(id_)) {
    const std::optional<Heartbeat> heartbeat = decode_heartbeat(frame);
    if (heartbeat) on_heartbeat(heartbeat->state, received.stamp, now);
  } else if (frame.id == emergency_cob_id(id_)) {
    if (const std::optional<Emergency> emergency = decode_emergency(frame)) on_emergency(*emergency, now);
  }
  return std::nullopt;
}

void DriveNode::on_heartbeat(NmtState state, Stamp stamp, Stamp now) {
  nmt_state_ = state;
  heartbeat_stamp_ = stamp;
  if (state != NmtState::boot_up) return;
  const bool expected = stage_ == Stage::booting && boot_.on_boot_up(now);
  if (expected) return;
  fail(DeviceErrorKind::device_fault,
       "unexpected boot-up: the drive was reset, or another node has its id; check its supply", now);
}

void DriveNode::on_emergency(const Emergency& emergency, Stamp now) {
  last_emergency_ = emergency;
  if (stage_ == Stage::operational && emergency.code != 0) {
    fail(DeviceErrorKind::device_fault, describe(emergency), now);
  }
}

void DriveNode::on_status(const StampedCanFrame& received, Stamp now) {
  if (!started_) return;
  const std::optional<DriveStatusPdo> status = decode_status(received.frame);
  if (!status) return fail(DeviceErrorKind::protocol, "TPDO1 of wrong length; check its mapping", now);
  status_stamp_ = received.stamp;
  statusword_ = status->statusword;
  state_ = decode_statusword(status->statusword);
  mode_ = status->mode;
  velocity_ = status->velocity;
  count_feedback(received.stamp);
  if (surplus_ < most_surplus || stage_ != Stage::operational) return;
  fail(DeviceErrorKind::protocol, "sends twice what it should: a second SYNC, or two nodes with this id", now);
}

std::optional<DriveNode::Travel> DriveNode::on_position(const StampedCanFrame& received, Stamp now) {
  if (!started_) return std::nullopt;
  const std::optional<DrivePositionPdo> feedback = decode_position(received.frame);
  if (!feedback) {
    fail(DeviceErrorKind::protocol, "TPDO2 of wrong length; check its mapping", now);
    return std::nullopt;
  }
  std::optional<Travel> travel;
  if (position_stamp_ && received.stamp > *position_stamp_) {
    travel = Travel{position_, feedback->position, received.stamp - *position_stamp_};
  }
  position_stamp_ = received.stamp;
  position_ = feedback->position;
  error_code_ = feedback->error_code;
  return travel;
}

std::optional<CanFrame> DriveNode::take_frame() {
  if (nmt_frame_) return std::exchange(nmt_frame_, std::nullopt);
  return boot_.take_frame();
}

// ---- supervision ----

std::optional<Stamp> DriveNode::feedback_stamp() const {
  if (!status_stamp_ || !position_stamp_) return std::nullopt;
  return std::min(*status_stamp_, *position_stamp_);
}

bool DriveNode::feedback_fresh(Stamp now) const {
  const std::optional<Stamp> stamp = feedback_stamp();
  return stamp && now - *stamp <= timing_.feedback_timeout;
}

bool DriveNode::at_rest(Stamp now) const {
  if (!started_) return true;
  if (!feedback_fresh(now) || std::abs(static_cast<double>(velocity_)) > standstill_) return false;
  return state_ != Cia402State::operation_enabled && state_ != Cia402State::fault_reaction_active;
}

bool DriveNode::without_power(Stamp now) const {
  if (!started_) return true;
  return feedback_fresh(now) && (state_ == Cia402State::switch_on_disabled || state_ == Cia402State::fault);
}

void DriveNode::supervise_communication(Stamp now) {
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

void DriveNode::count_feedback(Stamp stamp) {
  const double periods = std::max(seconds(stamp - counted_until_) / seconds(timing_.control_period), 0.0);
  counted_until_ = std::max(counted_until_, stamp);
  const double most_missing = seconds(timing_.feedback_timeout) / seconds(timing_.control_period);
  surplus_ = std::max(surplus_ + 1.0 - periods, -most_missing);
  if (surplus_ > 0.0) surplus_ = std::max(surplus_ - periods * forgotten_surplus, 0.0);
}

void DriveNode::supervise_drive(Stamp now) {
  if (state_ == Cia402State::unknown) {
    return fail(DeviceErrorKind::protocol, "statusword outside the standard's table", now);
  }
  if (state_ == Cia402State::fault || state_ == Cia402State::fault_reaction_active) {
    return fail(DeviceErrorKind::device_fault, std::string{to_string(state_)} + ", " + error_code_text(error_code_),
                now);
  }
  mode_confirmed_ = mode_confirmed_ || in_mode();
  if (!in_mode() && (mode_confirmed_ || now - mode_since_ > timing_.state_timeout)) {
    const std::string what = mode_confirmed_ ? "left mode " : "does not confirm mode ";
    return fail(DeviceErrorKind::device_fault,
                what + std::to_string(wanted_mode_) + ": it is in mode " + std::to_string(mode_), now);
  }
  if (following_ && state_ != Cia402State::operation_enabled) {
    fail(DeviceErrorKind::device_fault, std::string{"left operation enabled by itself: "} + to_string(state_), now);
  }
}

void DriveNode::supervise_transition(Stamp now) {
  const auto overdue = stepper_.overdue(now, timing_.quick_stop_timeout, timing_.state_timeout);
  if (!overdue) return;
  fail(DeviceErrorKind::refused,
       "transition " + std::to_string(overdue->number) + " to " + to_string(overdue->to) + " does not happen: still " +
           to_string(state_),
       now);
}

// ---- commands ----

void DriveNode::set_mode(std::int8_t mode, Stamp now) {
  if (mode == wanted_mode_) return;
  wanted_mode_ = mode;
  mode_since_ = now;
  mode_confirmed_ = false;
}

std::optional<Cia402Command> DriveNode::control(Cia402Goal goal, Stamp now) {
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
  following_ = goal == Cia402Goal::enabled && (following_ || state_ == Cia402State::operation_enabled);
  return controlword;
}

}  // namespace hogline::hw
