#include "hw/canopen/node_boot.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "hw/canopen/nmt.hpp"

namespace hogline::hw {
namespace {

constexpr ObjectAddress device_type{0x1000, 0};
constexpr ObjectAddress vendor_id{0x1018, 1};
constexpr ObjectAddress product_code{0x1018, 2};
constexpr ObjectAddress device_name_object{0x1008, 0};
constexpr ObjectAddress mode_display{0x6061, 0};
constexpr std::array identity_reads{device_type, vendor_id, product_code, device_name_object};

constexpr std::uint32_t drive_profile = 402;  // low word of 1000

std::string hex(std::uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "%08X", unsigned{value});
  return text;
}

bool lacks_object(const SdoResult& result) {
  return result.outcome == SdoResult::Outcome::aborted &&
         (result.abort_code == sdo_abort_no_object || result.abort_code == sdo_abort_no_sub_index);
}

const char* too_long(NodeBoot::Stage stage) {
  switch (stage) {
    case NodeBoot::Stage::identify:
      return "never answered; check its power, node id and the bit rate";
    case NodeBoot::Stage::reset_communication:
      return "sent no boot-up message after reset communication";
    case NodeBoot::Stage::confirm_mode:
      return "6061 never confirms the mode";
    default:
      return "configuration takes too long";
  }
}

}  // namespace

NodeBoot::NodeBoot(NodeIdentity identity, const DriveTiming& timing, std::vector<SdoWrite> setup, std::int8_t mode)
    : identity_(std::move(identity)),
      stage_timeout_(timing.boot_timeout),
      setup_(std::move(setup)),
      expected_(expected_after(setup_)),
      mode_(mode),
      sdo_(identity_.node, timing.sdo_timeout) {}

void NodeBoot::start(Stamp now) {
  cancel();
  failure_.reset();
  enter(Stage::identify, now);
}

void NodeBoot::cancel() {
  sdo_.cancel();
  outgoing_.clear();
  stage_ = Stage::idle;
}

void NodeBoot::enter(Stage stage, Stamp now) {
  stage_ = stage;
  stage_since_ = now;
  item_ = 0;
  // A node that was left stopped answers no SDO.
  if (stage == Stage::identify) outgoing_.push_back(nmt_frame(NmtCommand::enter_pre_operational, identity_.node));
  if (stage == Stage::reset_communication)
    outgoing_.push_back(nmt_frame(NmtCommand::reset_communication, identity_.node));
}

void NodeBoot::fail(DeviceErrorKind kind, std::string what) {
  cancel();
  failure_ = Failure{kind, std::move(what)};
}

void NodeBoot::fail(const SdoResult& result) {
  switch (result.outcome) {
    case SdoResult::Outcome::aborted:
      return fail(DeviceErrorKind::refused, result.describe());
    case SdoResult::Outcome::timeout:
      return fail(DeviceErrorKind::timeout, result.describe());
    default:
      return fail(DeviceErrorKind::protocol, result.describe());
  }
}

bool NodeBoot::on_boot_up(Stamp now) {
  if (stage_ == Stage::identify) return true;  // it was switched on later than we were
  if (stage_ != Stage::reset_communication) return false;
  enter(Stage::configure, now);
  return true;
}

void NodeBoot::step(Stamp now) {
  sdo_.step(now);
  switch (stage_) {
    case Stage::identify:
      identify(now);
      break;
    case Stage::configure:
      configure(now);
      break;
    case Stage::verify:
      verify(now);
      break;
    case Stage::confirm_mode:
      confirm_mode(now);
      break;
    default:
      break;
  }
  check_deadline(now);
}

void NodeBoot::check_deadline(Stamp now) {
  if (stage_ == Stage::idle || stage_ == Stage::done || now - stage_since_ <= stage_timeout_) return;
  const bool refusal = stage_ == Stage::confirm_mode;
  fail(refusal ? DeviceErrorKind::refused : DeviceErrorKind::timeout, too_long(stage_));
}

void NodeBoot::identify(Stamp now) {
  if (const std::optional<SdoResult> result = sdo_.take_result()) {
    // A node that has not booted yet is asked again until the stage's deadline.
    if (result->outcome != SdoResult::Outcome::timeout) {
      if (!accept_identity(identity_reads[item_], *result)) return;
      ++item_;
    }
  }
  if (sdo_.busy()) return;
  if (item_ == identity_reads.size()) return enter(Stage::reset_communication, now);
  sdo_.start_upload(identity_reads[item_], now);
}

bool NodeBoot::accept_identity(ObjectAddress address, const SdoResult& result) {
  const bool read = result.outcome == SdoResult::Outcome::ok;
  if (address == device_name_object && (read || lacks_object(result))) {
    device_name_.assign(result.data.begin(), result.data.end());
    return true;
  }
  if (!read) {
    fail(result);
    return false;
  }
  const std::uint32_t mask = address == device_type ? 0xFFFFu : 0xFFFFFFFFu;
  const std::optional<std::uint32_t> value = result.value();
  const std::uint32_t expected = expected_identity(address);
  if (value && (*value & mask) == expected) return true;
  fail(DeviceErrorKind::refused, "wrong identity: " + to_string(address) + " is " +
                                     (value ? hex(*value & mask) : "malformed") + ", expected " + hex(expected) +
                                     "; check the node ids");
  return false;
}

std::uint32_t NodeBoot::expected_identity(ObjectAddress address) const {
  if (address == device_type) return drive_profile;
  return address == vendor_id ? identity_.vendor_id : identity_.product_code;
}

void NodeBoot::configure(Stamp now) {
  if (const std::optional<SdoResult> result = sdo_.take_result()) {
    const bool not_needed = setup_[item_].optional && lacks_object(*result);
    if (result->outcome != SdoResult::Outcome::ok && !not_needed) return fail(*result);
    ++item_;
  }
  if (sdo_.busy()) return;
  if (item_ == setup_.size()) return enter(Stage::verify, now);
  sdo_.start_download(setup_[item_], now);
}

void NodeBoot::verify(Stamp now) {
  if (const std::optional<SdoResult> result = sdo_.take_result()) {
    if (!accept_held(expected_[item_], *result)) return;
    ++item_;
  }
  if (sdo_.busy()) return;
  if (item_ == expected_.size()) return enter(Stage::confirm_mode, now);
  sdo_.start_upload(expected_[item_].address, now);
}

bool NodeBoot::accept_held(const SdoExpectation& expected, const SdoResult& result) {
  if (expected.optional && lacks_object(result)) return true;
  if (result.outcome != SdoResult::Outcome::ok) {
    fail(result);
    return false;
  }
  const std::optional<std::uint32_t> value = result.value();
  if (value && (*value & expected.mask) == expected.value) return true;
  fail(DeviceErrorKind::refused, "SDO " + to_string(expected.address) + ": confirmed " + hex(expected.value) +
                                     " but holds " + (value ? hex(*value & expected.mask) : "something malformed"));
  return false;
}

void NodeBoot::confirm_mode(Stamp now) {
  if (const std::optional<SdoResult> result = sdo_.take_result()) {
    if (result->outcome != SdoResult::Outcome::ok) return fail(*result);
    if (result->value() == static_cast<std::uint8_t>(mode_)) return enter(Stage::done, now);
  }
  if (!sdo_.busy()) sdo_.start_upload(mode_display, now);
}

std::optional<CanFrame> NodeBoot::take_frame() {
  if (outgoing_.empty()) return sdo_.take_frame();
  const CanFrame frame = outgoing_.front();
  outgoing_.pop_front();
  return frame;
}

}  // namespace hogline::hw
