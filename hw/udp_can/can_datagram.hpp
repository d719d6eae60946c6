// A CAN frame as a datagram of python-can's udp_multicast bus (python-can 4, interfaces/udp_multicast/utils.py): a
// MessagePack map with the names of can.Message's arguments.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hw/can_bus.hpp"

namespace hogline::hw {

/// `unix_s`: the datagram's time stamp, seconds since 1970; whoever receives it takes his own.
std::vector<std::uint8_t> pack_can_frame(const CanFrame& frame, double unix_s);

/// Nothing for bytes that are no classic data or remote frame: error frames, CAN FD, identifiers or lengths out of
/// range, another data length than `dlc` says.
std::optional<CanFrame> unpack_can_frame(std::span<const std::uint8_t> datagram);

}  // namespace hogline::hw
