#include "hw/socketcan/can_filter.hpp"

#include <algorithm>

namespace hogline::hw {

bool CanFilter::matches(const CanFrame& frame) const {
  return frame.extended == extended && !frame.remote && (frame.id & mask) == (id & mask);
}

bool matches_any(std::span<const CanFilter> filters, const CanFrame& frame) {
  return std::any_of(filters.begin(), filters.end(), [&](const CanFilter& filter) { return filter.matches(frame); });
}

}  // namespace hogline::hw
