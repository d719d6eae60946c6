// The motor side of a simulated drive: speed loop seen from outside (dead time and first-order lag), encoder.
#pragma once

#include <cstdint>
#include <deque>
#include <utility>

#include "vision/percepts/stamp.hpp"

namespace hogline::hw::sim {

enum class AxisPower {
  unpowered,  ///< no torque: the axis turns freely
  driven,     ///< follows speed_radps
  braked,     ///< the holding brake is closed
};

/// What the drive does to its motor axis.
struct AxisCommand {
  AxisPower power = AxisPower::unpowered;
  double speed_radps = 0.0;  ///< while driven
};

struct DriveAxisConfig {
  double bandwidth_radps = 0.0;         ///< of the closed speed loop, first order; > 0
  double dead_time_s = 0.0;             ///< of the drive, beyond the bus
  double encoder_counts_per_rev = 0.0;  ///< after interpolation; > 0
  double velocity_window_s = 0.0;       ///< over which the drive differences its encoder; > 0
};

/// All at the motor axis.
class DriveAxis {
 public:
  explicit DriveAxis(const DriveAxisConfig& config) : config_(config) {}

  /// The axis turns with its true speed for dt. Precondition: dt_s > 0.
  void turn(double dt_s, double true_speed_radps);
  /// The speed the axis is driven with, dt after the previous call, for this demand.
  double follow(double dt_s, double demand_radps);
  /// Starts to follow from the axis' present speed: the drive was just enabled.
  void engage(double true_speed_radps);

  double position_rev() const { return position_rev_; }
  std::int64_t encoder_counts() const;
  /// From counts differenced over the window.
  double encoder_speed_rps() const;
  /// The encoder slips by this much against the axis.
  void slip_encoder(double revolutions) { position_rev_ += revolutions; }

 private:
  DriveAxisConfig config_;
  double position_rev_ = 0.0;
  double time_s_ = 0.0;
  double speed_radps_ = 0.0;
  std::deque<std::pair<double, double>> demands_;         ///< (time, demand), for the dead time
  std::deque<std::pair<double, std::int64_t>> readings_;  ///< (time, counts), for the window
};

}  // namespace hogline::hw::sim
