// Is what a wheel reports physically possible? Catches encoder jumps and scale errors, frozen contents in live frames,
// and a drive that claims to be enabled while its speed is another.
#pragma once

#include <optional>
#include <string>

#include "hw/canopen/drive_config.hpp"

namespace hogline::hw {

class FeedbackCheck {
 public:
  FeedbackCheck(const DrivePlausibility& limits, double max_speed_radps)
      : limits_(limits), max_speed_radps_(max_speed_radps) {}

  void restart();
  /// A pair of speed and way since the previous call, `dt` later. Precondition: dt > 0.
  void on_feedback(double travel_rad, double speed_radps, Duration dt);
  /// Once a step while the wheel is to follow set-points.
  void on_following(double target_radps, double speed_radps, Stamp now);
  /// Once a step while it is not.
  void on_not_following() { diverged_since_.reset(); }

  /// What is impossible, latched until restart().
  const std::optional<std::string>& problem() const { return problem_; }

 private:
  void report(const char* what, double value, double limit);

  DrivePlausibility limits_;
  double max_speed_radps_;
  std::optional<double> last_speed_radps_;
  double mismatch_rad_ = 0.0;
  std::optional<Stamp> diverged_since_;
  std::optional<std::string> problem_;
};

}  // namespace hogline::hw
