// Which identifiers a master of these nodes hears and sends: for the filters of a bus adapter.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hw/canopen/drive_config.hpp"

namespace hogline::hw {

struct BusIdentifiers {
  std::vector<std::uint32_t> heard;       ///< what the nodes send
  std::vector<std::uint32_t> own;         ///< what only the master sends: from anybody else it is a second master
  std::vector<std::uint32_t> set_points;  ///< of `own`: of no use when late, one at a time
};

/// A SYNC or heartbeat that is not among the duties comes from elsewhere and is nobody's offence. Precondition: node
/// numbers 1..127.
BusIdentifiers bus_identifiers(std::span<const std::uint8_t> nodes, std::uint8_t master_node, BusDuties duties = {});

}  // namespace hogline::hw
