#include "hw/canopen/nmt.hpp"

#include "hw/canopen/cob_id.hpp"

namespace hogline::hw {
namespace {

std::uint8_t state_byte(NmtState state) {
  switch (state) {
    case NmtState::boot_up:
      return 0x00;
    case NmtState::stopped:
      return 0x04;
    case NmtState::operational:
      return 0x05;
    case NmtState::pre_operational:
      return 0x7F;
    case NmtState::unknown:
      break;
  }
  return 0xFF;
}

NmtState state_from_byte(std::uint8_t byte) {
  switch (byte & 0x7F) {  // bit 7 is node guarding's toggle bit, reserved in a heartbeat
    case 0x00:
      return NmtState::boot_up;
    case 0x04:
      return NmtState::stopped;
    case 0x05:
      return NmtState::operational;
    case 0x7F:
      return NmtState::pre_operational;
    default:
      return NmtState::unknown;
  }
}

}  // namespace

CanFrame nmt_frame(NmtCommand command, std::uint8_t node) {
  return {.id = nmt_cob_id, .length = 2, .data = {static_cast<std::uint8_t>(command), node}};
}

CanFrame heartbeat_frame(std::uint8_t node, NmtState state) {
  return {.id = heartbeat_cob_id(node), .length = 1, .data = {state_byte(state)}};
}

CanFrame sync_frame() { return {.id = sync_cob_id, .length = 0, .data = {}}; }

std::optional<Heartbeat> decode_heartbeat(const CanFrame& frame) {
  if (!is_canopen_frame(frame) || frame.length != 1) return std::nullopt;
  if (frame.id <= 0x700 || frame.id > 0x77F) return std::nullopt;
  return Heartbeat{static_cast<std::uint8_t>(frame.id - 0x700), state_from_byte(frame.data[0])};
}

const char* to_string(NmtState state) {
  switch (state) {
    case NmtState::boot_up:
      return "boot-up";
    case NmtState::stopped:
      return "stopped";
    case NmtState::operational:
      return "operational";
    case NmtState::pre_operational:
      return "pre-operational";
    case NmtState::unknown:
      break;
  }
  return "unknown";
}

}  // namespace hogline::hw
