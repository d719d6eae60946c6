#include "hw/canopen/can_hub.hpp"

namespace hogline::hw {

std::optional<StampedCanFrame> CanHub::Endpoint::receive() {
  if (unread.empty()) hub_.distribute();
  if (unread.empty()) return std::nullopt;
  const StampedCanFrame oldest = unread.front();
  unread.pop_front();
  return oldest;
}

// One frame at a time: a flooded bus is the reader's to notice, by its own count of frames.
void CanHub::distribute() {
  const auto received = bus_.receive();
  if (!received) return;
  for (Endpoint& endpoint : endpoints_) {
    if (endpoint.unread.size() < most_unread) {
      endpoint.unread.push_back(*received);
    } else {
      ++lost_;
    }
  }
}

}  // namespace hogline::hw
