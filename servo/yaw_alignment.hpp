// The turn on the spot to the shot's heading: the visual-servoing law within the base's limits, past its stiction, to
// a standstill.
#pragma once

#include <optional>
#include <string>

#include "servo/thrower_config.hpp"
#include "servo/vanishing_point_task.hpp"

namespace hogline::servo {

struct AlignmentStep {
  bool ok = false;  ///< false: no turn may be ordered, `reason` says why
  std::string reason;
  double yaw_rate_radps = 0.0;
  double error_rad = 0.0;  ///< target less heading
  bool settled = false;    ///< error and rate have been within tolerance for the settle time
};

class YawAlignment {
 public:
  YawAlignment(const AlignmentConfig& config, const MotionLimits& limits, double target_heading_rad);

  /// One control period. `rate_radps`: the body's rate of turn as measured, bias removed.
  AlignmentStep step(double heading_rad, double rate_radps, Duration dt);

 private:
  double turn(double error_rad, double wanted_radps, double rate_radps, Duration dt);
  void learn_lag(double error_rad, double rate_radps, Duration dt);
  double limited(double wanted_radps, double error_rad, double dt_s) const;
  void judge(double error_rad, double rate_radps, Duration dt);

  AlignmentConfig config_;
  MotionLimits limits_;
  double target_rad_;
  VanishingPointTask task_;
  double lag_s_;  ///< the body turns on for so long
  struct Ended {
    double error_rad = 0.0;
    double rate_radps = 0.0;
  };
  std::optional<Ended> ended_;  ///< the last turn, until the body stands
  Duration standing_{};
  double ordered_radps_ = 0.0;
  bool turning_ = false;  ///< false: stands within tolerance, nothing is ordered
  Duration within_{};
};

}  // namespace hogline::servo
