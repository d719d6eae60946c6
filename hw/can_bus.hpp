// Port: a classic CAN bus.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

/// A classic CAN data frame (ISO 11898-1) with its 11- or 29-bit identifier.
struct CanFrame {
  std::uint32_t id = 0;
  bool extended = false;    ///< 29-bit identifier
  bool remote = false;      ///< remote transmission request: no data
  std::uint8_t length = 0;  ///< 0..8
  std::array<std::uint8_t, 8> data{};
  bool operator==(const CanFrame&) const = default;
};

/// A frame as received, with the moment of its reception.
struct StampedCanFrame {
  CanFrame frame;
  Stamp stamp{};
};

/// What became of a frame handed to send(). Anything but `sent` means that the frame is gone: it is never queued by the
/// adapter, so that a stale command can not reach a drive after the bus comes back.
enum class CanSendResult { sent, bus_down, would_block };

/// No call blocks.
class CanBus {
 public:
  virtual ~CanBus() = default;
  virtual CanSendResult send(const CanFrame& frame) = 0;
  /// The oldest frame received and not yet read, or nothing.
  virtual std::optional<StampedCanFrame> receive() = 0;
  /// False while the bus is off, the link is down or the adapter is gone.
  virtual bool up() const = 0;
  /// The controller has counted so many errors that it is one step from bus-off: frames still pass, the next may not.
  virtual bool error_passive() const { return false; }
};

}  // namespace hogline::hw
