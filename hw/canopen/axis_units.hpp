// Between an axis' radians and its drive's integers.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "hw/canopen/drive_config.hpp"

namespace hogline::hw {

class AxisUnits {
 public:
  /// Precondition: a gearing that config_error() accepts.
  explicit AxisUnits(const AxisGearing& g)
      : velocity_per_radps_(g.direction * motor_rev_per_rad(g) * g.velocity_units_per_motor_rps),
        counts_per_rad_(g.direction * motor_rev_per_rad(g) * g.position_counts_per_motor_rev),
        acceleration_per_radps2_(motor_rev_per_rad(g) * g.acceleration_units_per_motor_rps2) {}

  /// Precondition: finite and within the axis' greatest speed.
  std::int32_t velocity(double radps) const {
    return static_cast<std::int32_t>(std::lround(radps * velocity_per_radps_));
  }
  std::uint32_t speed(double radps) const { return static_cast<std::uint32_t>(std::abs(velocity(radps))); }
  double velocity_units(double radps) const { return std::abs(radps * velocity_per_radps_); }
  double radps(std::int32_t velocity) const { return velocity / velocity_per_radps_; }

  /// The way from one position to a later one, right across the counter's wrap.
  double travel_rad(std::int32_t from, std::int32_t to) const {
    const auto counts = static_cast<std::int32_t>(static_cast<std::uint32_t>(to) - static_cast<std::uint32_t>(from));
    return counts / counts_per_rad_;
  }

  /// Counts from where the angle is 0. Precondition: config_error() has made sure that they fit.
  std::int32_t counts(double angle_rad) const {
    return static_cast<std::int32_t>(std::lround(angle_rad * counts_per_rad_));
  }
  double angle_rad(std::int32_t counts) const { return counts / counts_per_rad_; }

  std::uint32_t acceleration(double radps2) const {
    return static_cast<std::uint32_t>(std::lround(radps2 * acceleration_per_radps2_));
  }

 private:
  static double motor_rev_per_rad(const AxisGearing& g) { return g.gear_ratio / (2.0 * std::numbers::pi); }

  double velocity_per_radps_;
  double counts_per_rad_;
  double acceleration_per_radps2_;
};

}  // namespace hogline::hw
