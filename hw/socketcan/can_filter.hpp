// Which frames a bus user wants to see.
#pragma once

#include <cstdint>
#include <span>

#include "hw/can_bus.hpp"

namespace hogline::hw {

/// Matches data frames whose identifier agrees with `id` in every bit set in `mask`, of one identifier length. Frames
/// of the other length and remote frames with the same number never match: a remote frame has no data to act on.
struct CanFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0x7FF;
  bool extended = false;

  bool matches(const CanFrame& frame) const;
};

/// True if one of the filters matches.
bool matches_any(std::span<const CanFilter> filters, const CanFrame& frame);

}  // namespace hogline::hw
