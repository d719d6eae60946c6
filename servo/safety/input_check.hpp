// What the inputs must be like for the robot to move: there, fresh, finite, plausible. Judged by the supervisor, and
// by the controller for itself.
#pragma once

#include <optional>
#include <string>

#include "servo/observation.hpp"
#include "servo/thrower_config.hpp"

namespace hogline::servo {

/// The inputs a state rests on. What is not needed is not judged by its age; what is there must be finite all the same.
struct InputNeeds {
  bool wheels = false;
  bool enabled = false;  ///< the drives follow commands
  bool gyro = false;
  bool gripper = false;
  bool holding = false;  ///< the gripper holds a stone
  bool arm = false;
  bool near_view = false;  ///< the camera delivers; percepts may be "not seen"
  bool low_view = false;
};

/// Judges one observation by itself. Empty: all good.
std::optional<std::string> bad_input(const ThrowerObservation& observation, Duration dt, const InputNeeds& needs,
                                     const ThrowerConfig& config);

}  // namespace hogline::servo
