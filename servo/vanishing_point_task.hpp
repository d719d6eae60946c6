// The visual-servoing task of the alignment: bring the vanishing point of the down-ice direction to where the near
// camera sees it when the body has the wanted heading.
#pragma once

#include <memory>
#include <string>

#include "servo/thrower_config.hpp"

namespace hogline::servo {

/// The control law's answer. `ok == false`: no law, with the reason; then the rate must not be used.
struct VanishingPointLaw {
  bool ok = false;
  std::string reason;
  double yaw_rate_radps = 0.0;
};

/// vpServo, eye in hand, one vanishing point (its interaction matrix has no translation part: no depth needed), base
/// Jacobian with the turn on the spot only, adaptive gain.
class VanishingPointTask {
 public:
  VanishingPointTask(const AlignmentConfig& config, double target_heading_rad);
  ~VanishingPointTask();
  VanishingPointTask(VanishingPointTask&&) noexcept;
  VanishingPointTask& operator=(VanishingPointTask&&) noexcept;

  /// `heading_rad`: of b in e, from the sheet pose, or predicted by the gyro since.
  VanishingPointLaw law(double heading_rad);

 private:
  struct Task;
  std::unique_ptr<Task> task_;
};

}  // namespace hogline::servo
