// Port: the robot's base, two driven wheels in velocity control.
#pragma once

#include <optional>

#include "hw/device_status.hpp"
#include "hw/drive_phase.hpp"

namespace hogline::hw {

/// Angular speeds of the two wheels; positive drives the robot forward, whatever way a motor is mounted.
struct WheelSpeeds {
  double left_radps = 0.0;
  double right_radps = 0.0;
};

struct DriveState {
  DrivePhase phase = DrivePhase::booting;
  Stamp stamp{};                     ///< of the older of the two wheels' newest feedback
  WheelSpeeds measured;              ///< from the drives' encoders
  std::optional<DeviceError> error;  ///< latched
};

/// Neither call blocks. step() does the talking; it is called every control period with the present time.
class Drive {
 public:
  virtual ~Drive() = default;
  virtual void step(Stamp now) = 0;
  virtual DriveState state() const = 0;
  /// Asks for power on the wheels. Refused (no effect) in any phase but ready and stopped.
  virtual void enable() = 0;
  /// The set-point for the next step(). It is sent once and ages: without a new one within the adapter's command age
  /// limit the drive is quick-stopped. Non-finite speeds are a fault and quick-stop.
  virtual void command(const WheelSpeeds& speeds, Stamp now) = 0;
  /// Brakes with the drives' own quick-stop ramp, from any phase.
  virtual void quick_stop() = 0;
  /// Clears a latched fault; the drive then needs enable() again.
  virtual void rearm() = 0;
};

}  // namespace hogline::hw
