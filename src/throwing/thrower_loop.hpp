// One control period of the thrower: devices to observation, controller, supervisor, what it permits to devices. It
// knows only the ports, and is the same on the simulated rink and on steel.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "servo/safety/supervisor.hpp"
#include "servo/thrower.hpp"
#include "src/throwing/thrower_devices.hpp"
#include "src/throwing/thrower_eyes.hpp"

namespace hogline {

class ThrowerLoop {
 public:
  ThrowerLoop(const ThrowerDevices& devices, ThrowerEyes eyes, servo::Thrower thrower, servo::Supervisor supervisor);

  /// The operator's act, before the first step: without it nothing moves. Returns why it was refused; the first step
  /// then aborts the throw for that reason.
  std::optional<std::string> arm(Stamp now);
  /// `now` is the present time, `dt` the time since the last call.
  void step(Stamp now, Duration dt);
  /// A release that the last step ordered for a moment before the next one. Whoever steps the loop calls let_go() then;
  /// a step that comes first does it as well as it still can.
  std::optional<Stamp> release_due() const { return release_due_; }
  void let_go(Stamp now);
  /// Somebody else of the team wants the robot to stop: for good, with the stone held if it still is.
  void stop(const std::string& reason);

  const servo::Thrower& thrower() const { return thrower_; }
  const servo::Supervisor& supervisor() const { return supervisor_; }
  const ThrowerEyes& eyes() const { return eyes_; }
  /// What the devices were given.
  const servo::ThrowerCommand& command() const { return command_; }
  /// Every device error since the start, in the order of their coming, also those that came after the first.
  const std::vector<hw::DeviceError>& device_errors() const { return device_errors_; }

 private:
  void note_errors();
  servo::ThrowerObservation observe(Stamp now) const;
  std::optional<std::string> safety_stop() const;
  vision::LowViewPrediction low_view_hint() const;
  void apply(const servo::ThrowerCommand& command, Stamp now);

  ThrowerDevices devices_;
  ThrowerEyes eyes_;
  servo::Thrower thrower_;
  servo::Supervisor supervisor_;
  servo::ThrowerCommand command_;  ///< as permitted
  std::string refusal_ = "not armed";
  std::optional<std::string> stopped_by_team_;
  std::vector<hw::DeviceError> device_errors_;
  void apply_jaws(const servo::GripperCommand& command, Stamp now);

  bool releasing_ = false;
  std::optional<Stamp> release_due_;
  servo::JawTrial trial_ = servo::JawTrial::none;
};

}  // namespace hogline
