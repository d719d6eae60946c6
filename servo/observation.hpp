// What the thrower's controller is told, once a control period. Plain structs; src fills them from hw and vision.
#pragma once

#include <optional>
#include <string>

#include "vision/percepts/sheet_pose.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

/// Wheel speeds as measured, positive forward.
struct WheelObservation {
  Stamp stamp{};
  double left_radps = 0.0;
  double right_radps = 0.0;
  bool ready = false;    ///< configured and can be enabled
  bool enabled = false;  ///< follows velocity commands
};

/// Rate of turn, counter-clockwise from above positive; raw, bias not removed.
struct GyroObservation {
  Stamp stamp{};
  double rate_radps = 0.0;
  bool valid = false;
};

struct GripperObservation {
  Stamp stamp{};
  bool holding = false;     ///< the jaws are closed on a stone
  bool open = false;        ///< the jaws are, or have begun to be, open
  double spin_radps = 0.0;  ///< of the held stone, counter-clockwise from above positive
  std::optional<Stamp> opening_since;
  std::optional<Stamp> freed_at;  ///< when the jaws had travelled as far as frees the stone, by their own report
};

struct ArmObservation {
  Stamp stamp{};
  bool folded = false;
  bool unfolded = false;
};

/// The operator's dead-man's switch.
struct OperatorObservation {
  Stamp stamp{};      ///< when its state was read
  bool held = false;  ///< pressed: motion is wanted
};

/// All of it. An empty optional means that nothing has arrived yet; what has arrived carries its stamp, and the
/// controller judges its age against `now`. `near_view` and `low_view` hold the newest percept, also when not ok.
struct ThrowerObservation {
  Stamp now{};
  std::optional<WheelObservation> wheels;
  std::optional<GyroObservation> gyro;
  std::optional<GripperObservation> gripper;
  std::optional<ArmObservation> arm;
  std::optional<SheetPosePercept> near_view;
  std::optional<SheetPosePercept> low_view;
  std::optional<OperatorObservation> operator_switch;  ///< only the supervisor looks at it
  std::optional<std::string> device_error;             ///< a latched error of any device, in words; stops the robot
  std::optional<std::string> safety_stop;              ///< why the supervisor lets nothing pass; stops the controller
};

}  // namespace hogline::servo
