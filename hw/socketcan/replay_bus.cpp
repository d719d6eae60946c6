#include "hw/socketcan/replay_bus.hpp"

#include <algorithm>

#include "hw/socketcan/can_error_frame.hpp"

namespace hogline::hw {

ReplayBus::ReplayBus(const std::vector<CandumpRecord>& log, const Clock& clock, Stamp start,
                     std::vector<CanFilter> ours)
    : clock_(clock) {
  Stamp due = start;
  for (const CandumpRecord& record : log) {
    due = std::max(due, start + (record.unix_time - log.front().unix_time));
    const StampedCanFrame stamped{record.frame, due};
    if (record.error_frame) {
      const CanErrorFrame error = decode_error_frame(record.frame.id, record.frame.data);
      if (error.state) states_.push_back({due, *error.state != CanControllerState::bus_off});
      continue;
    }
    const bool own = record.direction == CanDirection::transmitted ||
                     (record.direction == CanDirection::unknown && matches_any(ours, record.frame));
    (own ? transmitted_ : incoming_).push_back(stamped);
  }
}

CanSendResult ReplayBus::send(const CanFrame& frame) {
  if (!up()) return CanSendResult::bus_down;
  sent_.push_back({frame, clock_.now()});
  return CanSendResult::sent;
}

std::optional<StampedCanFrame> ReplayBus::receive() {
  if (ended() || incoming_[next_].stamp > clock_.now()) return std::nullopt;
  return incoming_[next_++];
}

bool ReplayBus::up() const {
  const auto later = std::upper_bound(states_.begin(), states_.end(), clock_.now(),
                                      [](Stamp now, const StateChange& change) { return now < change.due; });
  return later == states_.begin() || std::prev(later)->up;
}

}  // namespace hogline::hw
