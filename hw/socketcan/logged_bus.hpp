// Records what passes through any CanBus, in the stamps of that bus.
#pragma once

#include <string>

#include "hw/clock.hpp"
#include "hw/socketcan/can_tap.hpp"

namespace hogline::hw {

/// A CanBus that hands everything to another one and tells a tap of what was sent and received. SocketCanBus needs
/// none: it has a tap of its own, which also sees error frames and the kernel's proof of sending.
class LoggedBus final : public CanBus {
 public:
  /// `unix_time_at_zero` is added to stamps to make the log's times. All references must outlive this object.
  LoggedBus(CanBus& bus, const Clock& clock, CanTap& tap, std::string name,
            std::chrono::microseconds unix_time_at_zero);

  CanSendResult send(const CanFrame& frame) override;
  std::optional<StampedCanFrame> receive() override;
  bool up() const override { return bus_.up(); }
  bool error_passive() const override { return bus_.error_passive(); }

 private:
  void record(const CanFrame& frame, Stamp stamp, CanDirection direction);

  CanBus& bus_;
  const Clock& clock_;
  CanTap& tap_;
  CandumpRecord record_;  // reused: its name is not copied for each frame
  std::chrono::microseconds unix_time_at_zero_;
};

}  // namespace hogline::hw
