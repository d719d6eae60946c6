#include "hw/canopen/wheel_drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/wheel_drive_setup.hpp"

namespace hogline::hw {
namespace {

constexpr ObjectAddress device_type{0x1000, 0};
constexpr ObjectAddress vendor_id{0x1018, 1};
constexpr ObjectAddress product_code{0x1018, 2};
constexpr ObjectAddress device_name_object{0x1008, 0};
constexpr ObjectAddress mode_display{0x6061, 0};
constexpr std::array identity_reads{device_type, vendor_id, product_code, device_name_object};

constexpr std::uint32_t drive_profile = 402;  // low word of 1000

std::string missing_for(const char* what, Duration age) {
  char text[96];
  std::snprintf(text, sizeof text, "no %s for %.0f ms", what, seconds(age) * 1e3);
  return text;
}

std::string hex(std::uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "%08X", unsigned{value});
  return text;
}

bool lacks_object(const SdoResult& result) {
  return result.outcome == SdoResult::Outcome::aborted &&
         (result.abort_code == sdo_abort_no_object || result.abort_code == sdo_abort_no_sub_index);
}

std::string waiting_for(WheelDrive::Stage stage) {
  switch (stage) {
    case WheelDrive::Stage::identify:
      return "never answered; check its power, node id and the bit rate";
    case WheelDrive::Stage::reset_communication:
      return "sent no boot-up message after reset communication";
    case WheelDrive::Stage::configure:
      return "configuration takes too long";
    case WheelDrive::Stage::confirm_mode:
      return "6061 never confirms cyclic synchronous velocity";
    case WheelDrive::Stage::start:
      return "no heartbeat in operational with both TPDOs after NMT start";
    case WheelDrive::Stage::clear_fault:
      return "does not reach switch on disabled";
    default:
      return "boot takes too long";
  }
}

}  // namespace

WheelDrive::WheelDrive(const WheelConfig& wheel, const TwoWheelDriveConfig& config)
    : wheel_(wheel),
      timing_(config.timing),
      standstill_radps_(config.plausibility.standstill_radps),
      label_(wheel.name + " (node " + std::to_string(wheel.node) + ")"),
      units_(wheel),
      setup_(wheel_drive_setup(wheel, config.timing, config.master_node)),
      sdo_(wheel.node, config.timing.sdo_timeout),
      check_(config.plausibility, wheel.max_speed_radps) {}

// ---- boot ----

void WheelDrive::boot(Stamp now) {
  sdo_.cancel();
  outgoing_.clear();
  started_ = false;
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
  enter(Stage::identify, now);
}

void WheelDrive::enter(Stage stage, Stamp now) {
  stage_ = stage;
  stage_since_ = now;
  stage_item_ = 0;
  if (stage == Stage::reset_communication) outgoing_.push_back(nmt_frame(NmtCommand::reset_communication, wheel_.node));
  if (stage == Stage::start) {
    outgoing_.push_back(nmt_frame(NmtCommand::start, wheel_.node));
    heartbeat_stamp_.reset();
    status_stamp_.reset();
    position_stamp_.reset();
    started_ = true;
  }
}

void WheelDrive::fail(DeviceErrorKind kind, std::string what, Stamp now) {
  if (error_) return;
  error_ = DeviceError{kind, label_, std::move(what), now};
  stage_ = Stage::failed;
  sdo_.cancel();
  outgoing_.clear();
}

void WheelDrive::fail(const SdoResult& result, Stamp now) {
  switch (result.outcome) {
    case SdoResult::Outcome::aborted:
      return fail(DeviceErrorKind::refused, result.describe(), now);
    case SdoResult::Outcome::timeout:
      return fail(DeviceErrorKind::timeout, result.describe(), now);
    default:
      return fail(DeviceErrorKind::protocol, result.describe(), now);
  }
}

void WheelDrive::step(Stamp now) {
  sdo_.step(now);
  switch (stage_) {
    case Stage::identify:
      continue_identify(now);
      break;
    case Stage::configure:
      continue_configure(now);
      break;
    case Stage::confirm_mode:
      continue_confirm_mode(now);
      break;
    case Stage::start:
      continue_start(now);
      break;
    case Stage::clear_fault:
      continue_clear_fault(now);
      break;
    case Stage::operational:
      supervise_communication(now);
      supervise_drive(now);
      supervise_transition(now);
      break;
    case Stage::idle:
    case Stage::reset_communication:
    case Stage::failed:
      break;
  }
  check_stage_deadline(now);
}

void WheelDrive::check_stage_deadline(Stamp now) {
  if (stage_ == Stage::idle || stage_ == Stage::operational || stage_ == Stage::failed) return;
  if (now - stage_since_ <= timing_.boot_timeout) return;
  std::string what = waiting_for(stage_);
  if (last_emergency_ && last_emergency_->code != 0) what += "; last " + describe(*last_emergency_);
  const bool refusal = stage_ == Stage::confirm_mode || stage_ == Stage::clear_fault;
  fail(refusal ? DeviceErrorKind::refused : DeviceErrorKind::timeout, what, now);
}

void WheelDrive::continue_identify(Stamp now) {
  if (const std::optional<SdoResult> result = sdo_.take_result()) {
    const ObjectAddress address = identity_reads[stage_item_];
    // A node that has not booted yet is asked again until the stage's deadline.
    if (result->outcome != SdoResult::Outcome::timeout) {
      if (!identity_matches(address, *result, now)) return;
      ++stage_item_;
    }
  }
  if (sdo_.busy()) return;
  if (stage_item_ == identity_reads.size()) return enter(Stage::reset_communication, now);
  sdo_.start_upload(identity_reads[stage_item_], now);
}

bool WheelDrive::identity_matches(ObjectAddress address, const SdoResult& result, Stamp now) {
  if (address == device_name_object) {
    if (result.outcome == SdoResult::Outcome::ok) device_name_.assign(result.data.begin(), result.data.end());
    if (result.outcome == SdoResult::Outcome::ok || lacks_object(result)) return true;
    fail(result, now);
    return false;
  }
  const std::optional<std::uint32_t> value = result.value();
  if (result.outcome != SdoResult::Outcome::ok) {
    fail(result, now);
    return false;
  }
  const std::uint32_t expected = address == device_type ? drive_profile
                                 : address == vendor_id ? wheel_.vendor_id
                                                        : wheel_.product_code;
  const std::uint32_t mask = address == device_type ? 0xFFFFu : 0xFFFFFFFFu;
  if (value && (*value & mask) == expected) return true;
  fail(DeviceErrorKind::refused,
       "wrong identity: " + to_string(address) + " is " + (value ? hex(*value & mask) : "malformed") + ", expected " +
           hex(expected) + "; check the node ids",
       now);
  return false;
}

void WheelDrive::continue_configure(Stamp now) {
  if (const std::optional<SdoResult> result = sdo_.take_result()) {
    const bool skipped = setup_[stage_item_].optional && lacks_object(*result);
    if (result->outcome != SdoResult::Outcome::ok && !skipped) return fail(*result, now);
    ++stage_item_;
  }
  if (sdo_.busy()) return;
  if (stage_item_ == setup_.size()) return enter(Stage::confirm_mode, now);
  sdo_.start_download(setup_[stage_item_], now);
}

void WheelDrive::continue_confirm_mode(Stamp now) {
  if (const std::optional<SdoResult> result = sdo_.take_result()) {
    if (result->outcome != SdoResult::Outcome::ok) return fail(*result, now);
    if (result->value() == static_cast<std::uint32_t>(cyclic_sync_velocity_mode)) return enter(Stage::start, now);
  }
  if (!sdo_.busy()) sdo_.start_upload(mode_display, now);
}

void WheelDrive::continue_start(Stamp now) {
  if (nmt_state_ == NmtState::operational && heartbeat_stamp_ && feedback_fresh(now)) enter(Stage::clear_fault, now);
}

void WheelDrive::continue_clear_fault(Stamp now) {
  supervise_communication(now);
  if (stage_ == Stage::clear_fault && state_ == Cia402State::switch_on_disabled) {
    check_.restart();
    enter(Stage::operational, now);
  }
}

// ---- frames ----

void WheelDrive::on_frame(const StampedCanFrame& received, Stamp now) {
  const CanFrame& frame = received.frame;
  if (stage_ == Stage::idle || !is_canopen_frame(frame)) return;
  if (frame.id == tpdo_cob_id(1, wheel_.node)) return on_status(received, now);
  if (frame.id == tpdo_cob_id(2, wheel_.node)) return on_position(received, now);
  if (frame.id == sdo_response_cob_id(wheel_.node)) return sdo_.on_frame(frame, now);
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
  if (stage_ == Stage::reset_communication) return enter(Stage::configure, now);
  if (stage_ != Stage::identify) {
    fail(DeviceErrorKind::device_fault, "unexpected boot-up: the drive was reset; check its supply", now);
  }
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
  if (!outgoing_.empty()) {
    const CanFrame frame = outgoing_.front();
    outgoing_.pop_front();
    return frame;
  }
  return sdo_.take_frame();
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
    return fail(DeviceErrorKind::device_fault,
                std::string{to_string(state_)} + ", error code " + hex(error_code_).substr(4) + " (" +
                    emergency_meaning(error_code_) + ")",
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
  if (stage_ != Stage::operational) {
    goal = stage_ == Stage::failed && goal != Cia402Goal::off ? Cia402Goal::stopped : goal;
    if (stage_ == Stage::clear_fault) goal = Cia402Goal::reset;
    if (stage_ == Stage::start) goal = Cia402Goal::off;
  }
  const Cia402Command controlword = stepper_.step(state_, goal, now);
  was_enabled_ = goal == Cia402Goal::enabled && (was_enabled_ || state_ == Cia402State::operation_enabled);
  target_radps_ = was_enabled_ ? target_radps : 0.0;
  return encode(WheelCommandPdo{controlword, units_.velocity(target_radps_)}, wheel_.node);
}

}  // namespace hogline::hw
