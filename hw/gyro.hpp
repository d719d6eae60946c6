// Port: the single-axis fibre-optic gyro about the body's z axis.
#pragma once

#include <optional>

#include "hw/device_status.hpp"

namespace hogline::hw {

/// What the gyro shows while the body stands, the earth's rate removed.
struct GyroBias {
  double radps = 0.0;
  double sigma_radps = 0.0;
};

struct GyroState {
  double rate_radps = 0.0;  ///< against the ice, counter-clockwise from above positive; bias not removed
  bool valid = false;       ///< the device's own valid flag, and plausible
  Stamp stamp{};
  std::optional<GyroBias> bias;      ///< from times at rest; nothing before the first
  std::optional<DeviceError> error;  ///< latched
};

class Gyro {
 public:
  virtual ~Gyro() = default;
  virtual void step(Stamp now) = 0;
  virtual GyroState state() const = 0;
  /// Whether the body is known to stand, by other means than this gyro (its wheels), since the last call. The bias is
  /// estimated and watched only then.
  virtual void at_rest(bool resting) = 0;
  /// Clears a latched error.
  virtual void rearm() = 0;
};

}  // namespace hogline::hw
