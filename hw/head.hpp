// Port: the pan-tilt head that carries the near and far cameras.
#pragma once

#include <optional>

#include "hw/device_status.hpp"
#include "hw/drive_phase.hpp"

namespace hogline::hw {

/// Pan about the body's z axis, counter-clockwise positive; tilt positive looks down.
struct PanTilt {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
};

struct PanTiltRate {
  double pan_radps = 0.0;
  double tilt_radps = 0.0;
};

struct HeadState {
  DrivePhase phase = DrivePhase::booting;
  Stamp stamp{};  ///< of the older of the two axes' newest feedback
  PanTilt measured;
  PanTiltRate rate;
  bool on_target = false;            ///< stands where the last point() wanted it
  std::optional<DeviceError> error;  ///< latched
};

/// No call blocks. step() does the talking; it is called every control period with the present time.
class Head {
 public:
  virtual ~Head() = default;
  virtual void step(Stamp now) = 0;
  virtual HeadState state() const = 0;
  /// Asks for power. Refused (no effect) in any phase but ready and stopped. An enabled head holds its position.
  virtual void enable() = 0;
  /// Goes there by a smooth profile and stays. A newer target replaces an older one at once. Only while enabled. Angles
  /// that are not finite or beyond the head's limits are a fault and stop it.
  virtual void point(const PanTilt& target, Stamp now) = 0;
  /// Turns with these rates until the next step() that finds them older than the adapter's command age limit; then it
  /// stands. Slows down in time for its limits. Only while enabled. Rates that are not finite or too fast are a fault.
  virtual void track(const PanTiltRate& rates, Stamp now) = 0;
  /// Brakes with the drives' own quick-stop ramp and takes the power away.
  virtual void stop() = 0;
  /// Clears a latched fault; the head then needs enable() again.
  virtual void rearm() = 0;
};

}  // namespace hogline::hw
