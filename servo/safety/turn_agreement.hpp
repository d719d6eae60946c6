// Gyro against wheels.
#pragma once

#include <optional>
#include <string>

#include "servo/thrower_config.hpp"

namespace hogline::servo {

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

}  // namespace hogline::servo
