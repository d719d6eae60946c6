// One control period of the thrower: devices to observation, controller, command to devices. It knows only the ports,
// and is the same on the simulated rink and on steel.
#pragma once

#include <vector>

#include "servo/thrower.hpp"
#include "src/throwing/thrower_devices.hpp"
#include "src/throwing/thrower_eyes.hpp"

namespace hogline {

class ThrowerLoop {
 public:
  ThrowerLoop(const ThrowerDevices& devices, ThrowerEyes eyes, servo::Thrower thrower);

  /// `now` is the present time, `dt` the time since the last call.
  void step(Stamp now, Duration dt);

  const servo::Thrower& thrower() const { return thrower_; }
  const ThrowerEyes& eyes() const { return eyes_; }
  const servo::ThrowerCommand& command() const { return command_; }
  /// Every device error since the start, in the order of their coming, also those that came after the first.
  const std::vector<hw::DeviceError>& device_errors() const { return device_errors_; }

 private:
  void note_errors();
  servo::ThrowerObservation observe(Stamp now) const;
  vision::LowViewPrediction low_view_hint() const;
  void apply(const servo::ThrowerCommand& command, Stamp now);

  ThrowerDevices devices_;
  ThrowerEyes eyes_;
  servo::Thrower thrower_;
  servo::ThrowerCommand command_;
  std::vector<hw::DeviceError> device_errors_;
  bool releasing_ = false;
};

}  // namespace hogline
