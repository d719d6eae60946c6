#include "hw/socketcan/logged_bus.hpp"

#include <utility>

namespace hogline::hw {

LoggedBus::LoggedBus(CanBus& bus, const Clock& clock, CanTap& tap, std::string name,
                     std::chrono::microseconds unix_time_at_zero)
    : bus_(bus), clock_(clock), tap_(tap), unix_time_at_zero_(unix_time_at_zero) {
  record_.interface = std::move(name);
}

CanSendResult LoggedBus::send(const CanFrame& frame) {
  const CanSendResult result = bus_.send(frame);
  if (result == CanSendResult::sent) record(frame, clock_.now(), CanDirection::transmitted);
  return result;
}

std::optional<StampedCanFrame> LoggedBus::receive() {
  auto received = bus_.receive();
  if (received) record(received->frame, received->stamp, CanDirection::received);
  return received;
}

void LoggedBus::record(const CanFrame& frame, Stamp stamp, CanDirection direction) {
  record_.unix_time =
      unix_time_at_zero_ + std::chrono::duration_cast<std::chrono::microseconds>(stamp.time_since_epoch());
  record_.frame = frame;
  record_.direction = direction;
  tap_.record(record_);
}

}  // namespace hogline::hw
