// What the thrower's controller orders, once a control period. Plain structs; src hands them to hw.
#pragma once

#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

enum class DriveOrder {
  off,         ///< no torque asked for
  enable,      ///< ask for power, stand still
  velocity,    ///< follow the wheel speeds
  quick_stop,  ///< brake on the drives' own ramp
};

struct DriveCommand {
  DriveOrder order = DriveOrder::off;
  double left_radps = 0.0;
  double right_radps = 0.0;
};

/// In the hack, before anything else is asked of the robot, the jaws may be tried on the standing stone.
enum class JawTrial {
  none,
  open,  ///< set the stone down
  grip,  ///< take it up again
};

struct GripperCommand {
  bool release = false;             ///< false keeps the stone: the default in every doubt
  double spin_radps = 0.0;          ///< of the held stone, counter-clockwise from above positive
  Duration release_in{};            ///< the release's moment within this control period, from its beginning
  JawTrial trial = JawTrial::none;  ///< besides a release it means nothing
};

enum class ArmOrder { hold, fold, unfold };
enum class CameraOrder { none, near, low };

struct ThrowerCommand {
  DriveCommand drive;
  GripperCommand gripper;
  ArmOrder arm = ArmOrder::hold;
  CameraOrder camera = CameraOrder::none;  ///< whose frames the controller needs now
};

}  // namespace hogline::servo
