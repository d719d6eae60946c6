// Port: the pan-tilt head that carries the near and far cameras.
#pragma once

#include <optional>

#include "hw/device_status.hpp"

namespace hogline::hw {

/// Pan about the body's z axis, counter-clockwise positive; tilt positive looks down.
struct PanTilt {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
};

struct HeadState {
  PanTilt measured;
  Stamp stamp{};
  bool enabled = false;
  std::optional<DeviceError> error;  ///< latched
};

class Head {
 public:
  virtual ~Head() = default;
  virtual void step(Stamp now) = 0;
  virtual HeadState state() const = 0;
  virtual void enable() = 0;
  virtual void point(const PanTilt& target) = 0;
  virtual void stop() = 0;
};

}  // namespace hogline::hw
