#include "servo/unicycle.hpp"

namespace hogline::servo {

WheelPair wheels_of(const PlanarTwist& twist, const BaseGeometry& base) {
  const double difference = twist.yaw_rate_radps * base.track_m / 2.0;
  return {(twist.forward_mps - difference) / base.wheel_radius_m,
          (twist.forward_mps + difference) / base.wheel_radius_m};
}

PlanarTwist twist_of(const WheelPair& wheels, const BaseGeometry& base) {
  return {base.wheel_radius_m * (wheels.right_radps + wheels.left_radps) / 2.0,
          base.wheel_radius_m * (wheels.right_radps - wheels.left_radps) / base.track_m};
}

}  // namespace hogline::servo
