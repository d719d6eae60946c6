// Port: the folding arm that carries the head with the near and far cameras.
#pragma once

#include <optional>

#include "hw/device_status.hpp"

namespace hogline::hw {

enum class ArmPosition { unknown, folded, moving, unfolded };

struct ArmState {
  ArmPosition position = ArmPosition::unknown;
  Stamp stamp{};                     ///< of the newest answer that was checked by its content
  std::optional<DeviceError> error;  ///< latched
};

/// Never blocks the caller.
class Arm {
 public:
  virtual ~Arm() = default;
  virtual void step(Stamp now) = 0;
  virtual ArmState state() const = 0;
  virtual void fold() = 0;
  virtual void unfold() = 0;
  /// Clears a latched error; nothing moves before a new order.
  virtual void rearm() = 0;
};

}  // namespace hogline::hw
