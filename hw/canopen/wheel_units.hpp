// Between a wheel's radians and its drive's integers.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "hw/canopen/drive_config.hpp"

namespace hogline::hw {

class WheelUnits {
 public:
  /// Precondition: a wheel that config_error() accepts.
  explicit WheelUnits(const WheelConfig& wheel)
      : velocity_per_radps_(wheel.direction * motor_rev_per_wheel_rad(wheel) * wheel.velocity_units_per_motor_rps),
        counts_per_rad_(wheel.direction * motor_rev_per_wheel_rad(wheel) * wheel.position_counts_per_motor_rev),
        acceleration_per_radps2_(motor_rev_per_wheel_rad(wheel) * wheel.acceleration_units_per_motor_rps2) {}

  /// Precondition: finite and within the wheel's max_speed_radps.
  std::int32_t velocity(double wheel_radps) const {
    return static_cast<std::int32_t>(std::lround(wheel_radps * velocity_per_radps_));
  }
  double radps(std::int32_t velocity) const { return velocity / velocity_per_radps_; }

  /// The way from one position to a later one, right across the counter's wrap.
  double travel_rad(std::int32_t from, std::int32_t to) const {
    const auto counts = static_cast<std::int32_t>(static_cast<std::uint32_t>(to) - static_cast<std::uint32_t>(from));
    return counts / counts_per_rad_;
  }

  std::uint32_t acceleration(double wheel_radps2) const {
    return static_cast<std::uint32_t>(std::lround(wheel_radps2 * acceleration_per_radps2_));
  }

 private:
  static double motor_rev_per_wheel_rad(const WheelConfig& wheel) {
    return wheel.gear_ratio / (2.0 * std::numbers::pi);
  }

  double velocity_per_radps_;
  double counts_per_rad_;
  double acceleration_per_radps2_;
};

}  // namespace hogline::hw
