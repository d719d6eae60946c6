// Port: the jaws that hold the stone and the belt that spins it.
#pragma once

#include <optional>

#include "hw/device_status.hpp"

namespace hogline::hw {

enum class JawState { unknown, moving, open, holding, closed_empty };

struct GripperState {
  JawState jaws = JawState::unknown;
  bool activated = false;
  double spin_radps = 0.0;             ///< of the stone, counter-clockwise from above positive
  Stamp stamp{};                       ///< of the newest answer that was checked by its content
  std::optional<Stamp> opening_since;  ///< when the device first reported that the jaws open
  std::optional<Stamp> freed_at;       ///< when the jaws had opened as far as frees the stone, by the device's report
  std::optional<DeviceError> error;    ///< latched
};

/// Never blocks the caller: requests are taken and carried out by step() or by the adapter's own thread.
class Gripper {
 public:
  virtual ~Gripper() = default;
  virtual void step(Stamp now) = 0;
  virtual GripperState state() const = 0;
  virtual void grip() = 0;
  virtual void release() = 0;
  /// Spins the held stone at this rate, counter-clockwise from above positive.
  virtual void spin(double radps) = 0;
  /// Clears a latched error; nothing moves before a new order. The operator's word that jaws which are not activated
  /// hold no stone.
  virtual void rearm() = 0;
};

}  // namespace hogline::hw
