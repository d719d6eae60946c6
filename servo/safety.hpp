// What the inputs must be like for the robot to move: fresh, finite, plausible, in agreement. The first failure is
// latched.
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

/// Gyro against wheels: their rates of turn must agree, but for slips shorter than the allowed time.
class TurnAgreement {
 public:
  explicit TurnAgreement(const SafetyConfig& config) : config_(config) {}
  /// Rates of turn, the gyro's less its bias. Returns the reason when they have disagreed for too long.
  std::optional<std::string> judge(double gyro_radps, double wheels_radps, Duration dt);

 private:
  SafetyConfig config_;
  Duration disagreeing_{};
};

/// Keeps the first reason.
class Latch {
 public:
  void set(const std::optional<std::string>& reason) {
    if (!reason_ && reason) reason_ = reason;
  }
  const std::optional<std::string>& reason() const { return reason_; }

 private:
  std::optional<std::string> reason_;
};

}  // namespace hogline::servo
