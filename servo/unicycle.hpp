// The two-wheeled base as a unicycle: twist to wheel speeds and back, and its Jacobian for visual servoing.
#pragma once

#include <array>

#include "servo/thrower_config.hpp"

namespace hogline::servo {

/// Velocity of b's origin along b's x axis, and rate of turn about b's z axis (counter-clockwise from above positive).
struct PlanarTwist {
  double forward_mps = 0.0;
  double yaw_rate_radps = 0.0;
};

/// Wheel speeds, positive forward.
struct WheelPair {
  double left_radps = 0.0;
  double right_radps = 0.0;
};

constexpr WheelPair wheels_of(const PlanarTwist& twist, const BaseGeometry& base) {
  const double difference = twist.yaw_rate_radps * base.track_m / 2.0;
  return {(twist.forward_mps - difference) / base.wheel_radius_m,
          (twist.forward_mps + difference) / base.wheel_radius_m};
}

constexpr PlanarTwist twist_of(const WheelPair& wheels, const BaseGeometry& base) {
  return {base.wheel_radius_m * (wheels.right_radps + wheels.left_radps) / 2.0,
          base.wheel_radius_m * (wheels.right_radps - wheels.left_radps) / base.track_m};
}

/// eJe of vpServo, 6 x 2, row by row: maps (forward speed, yaw rate) to b's twist in b, translation first.
constexpr std::array<double, 12> unicycle_jacobian() { return {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}; }

/// The second column alone, 6 x 1: the base that turns on the spot.
constexpr std::array<double, 6> turning_jacobian() { return {0, 0, 0, 0, 0, 1}; }

}  // namespace hogline::servo
