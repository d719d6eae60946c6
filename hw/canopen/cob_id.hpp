// The predefined connection set of CiA 301 (7.3.3): which 11-bit identifier carries what.
#pragma once

#include <cstdint>

#include "hw/can_bus.hpp"

namespace hogline::hw {

inline constexpr std::uint32_t nmt_cob_id = 0x000;
inline constexpr std::uint32_t sync_cob_id = 0x080;

// Precondition of all: node 1..127, PDO number 1..4.
constexpr std::uint32_t emergency_cob_id(std::uint8_t node) { return 0x080u + node; }
constexpr std::uint32_t tpdo_cob_id(int number, std::uint8_t node) { return 0x080u + 0x100u * number + node; }
constexpr std::uint32_t rpdo_cob_id(int number, std::uint8_t node) { return 0x100u + 0x100u * number + node; }
constexpr std::uint32_t sdo_response_cob_id(std::uint8_t node) { return 0x580u + node; }
constexpr std::uint32_t sdo_request_cob_id(std::uint8_t node) { return 0x600u + node; }
constexpr std::uint32_t heartbeat_cob_id(std::uint8_t node) { return 0x700u + node; }

/// Whether the frame can be CANopen at all: a data frame with an 11-bit identifier and a legal length. Remote and
/// 29-bit frames with a matching number are somebody else's.
constexpr bool is_canopen_frame(const CanFrame& frame) {
  return !frame.extended && !frame.remote && frame.id <= 0x7FF && frame.length <= 8;
}

}  // namespace hogline::hw
