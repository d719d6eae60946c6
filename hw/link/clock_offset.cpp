#include "hw/link/clock_offset.hpp"

#include <algorithm>

namespace hogline::hw::link {

void ClockOffset::add(TeamTime sent, TeamTime heard, TeamTime answered, TeamTime received) {
  const Duration held = answered - heard;
  const Duration whole = received - sent;
  if (held < Duration::zero() || whole < held) return;
  // (there - here) on the way out and on the way back: what the ways have in common cancels.
  last_[count_++ % last_.size()] = {.offset = ((heard - sent) + (answered - received)) / 2, .round_trip = whole - held};
}

std::optional<OffsetEstimate> ClockOffset::estimate() const {
  if (count_ == 0) return std::nullopt;
  const auto end = last_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, last_.size()));
  const auto best = std::min_element(last_.begin(), end,
                                     [](const Exchange& a, const Exchange& b) { return a.round_trip < b.round_trip; });
  return OffsetEstimate{.offset = best->offset, .round_trip = best->round_trip, .bound = best->round_trip / 2};
}

}  // namespace hogline::hw::link
