// Port: the single-axis fibre-optic gyro about the body's z axis.
#pragma once

#include <optional>

#include "hw/device_status.hpp"

namespace hogline::hw {

struct GyroState {
  double rate_radps = 0.0;  ///< counter-clockwise from above positive; raw, bias not removed
  bool valid = false;       ///< the device's own valid flag, and plausible
  Stamp stamp{};
  std::optional<DeviceError> error;  ///< latched
};

class Gyro {
 public:
  virtual ~Gyro() = default;
  virtual void step(Stamp now) = 0;
  virtual GyroState state() const = 0;
};

}  // namespace hogline::hw
