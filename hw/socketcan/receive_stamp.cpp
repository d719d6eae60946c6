#include "hw/socketcan/receive_stamp.hpp"

#include <algorithm>

namespace hogline::hw {

std::optional<Stamp> to_steady(Duration wall, const ClockPair& now, Duration oldest) {
  const Duration age = now.wall - wall;
  if (age < std::chrono::milliseconds(-1) || age > oldest) return std::nullopt;
  return now.steady - std::max(age, Duration::zero());
}

}  // namespace hogline::hw
