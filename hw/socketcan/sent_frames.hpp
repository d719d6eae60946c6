// Frames handed to the kernel and not yet seen on the bus.
#pragma once

#include <array>
#include <cstdint>

#include "hw/can_bus.hpp"

namespace hogline::hw {

/// A bounded list, oldest first. Controllers with several mailboxes may send a higher priority first, so a confirmation
/// is matched by content and need not be the oldest.
class SentFrames {
 public:
  static constexpr std::size_t capacity = 64;

  /// Returns false if the list is full: the oldest frame is then forgotten.
  bool add(const CanFrame& frame, Stamp now);
  /// Takes the oldest equal frame out; false if there is none.
  bool confirm(const CanFrame& frame);
  /// True if a frame of this identifier is among them.
  bool holds(const CanFrame& like) const;
  /// Takes out what was sent before `limit`, and says how many.
  std::uint64_t expire(Stamp limit);
  void clear() { count_ = 0; }

  std::size_t size() const { return count_; }
  std::optional<Stamp> oldest() const;

 private:
  void erase(std::size_t position);

  std::array<StampedCanFrame, capacity> frames_;
  std::size_t count_ = 0;
};

}  // namespace hogline::hw
