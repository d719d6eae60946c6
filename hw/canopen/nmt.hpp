// Network management, heartbeat and SYNC of CiA 301: frames in and out, no IO.
#pragma once

#include <cstdint>
#include <optional>

#include "hw/can_bus.hpp"

namespace hogline::hw {

/// Command specifiers (7.2.8.3.1).
enum class NmtCommand : std::uint8_t {
  start = 0x01,
  stop = 0x02,
  enter_pre_operational = 0x80,
  reset_node = 0x81,
  reset_communication = 0x82,
};

/// The state byte of a heartbeat (7.2.8.3.2.2). `unknown` is any byte the standard does not define.
enum class NmtState { unknown, boot_up, stopped, operational, pre_operational };

struct Heartbeat {
  std::uint8_t node = 0;
  NmtState state = NmtState::unknown;
};

/// Precondition: node 1..127.
CanFrame nmt_frame(NmtCommand command, std::uint8_t node);
CanFrame heartbeat_frame(std::uint8_t node, NmtState state);
CanFrame sync_frame();

/// Nothing if the frame is not one byte on 701..77F.
std::optional<Heartbeat> decode_heartbeat(const CanFrame& frame);

const char* to_string(NmtState state);

}  // namespace hogline::hw
