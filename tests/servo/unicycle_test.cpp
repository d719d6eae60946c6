#include "servo/unicycle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

double between(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

RC_GTEST_PROP(Unicycle, WheelsAndTwistAreInverse, ()) {
  const BaseGeometry base{between(0.03, 0.3), between(0.2, 1.0)};
  const PlanarTwist twist{between(-4.0, 4.0), between(-2.0, 2.0)};
  const PlanarTwist back = twist_of(wheels_of(twist, base), base);
  RC_ASSERT(std::abs(back.forward_mps - twist.forward_mps) < 1e-12);
  RC_ASSERT(std::abs(back.yaw_rate_radps - twist.yaw_rate_radps) < 1e-12);
}

TEST(Unicycle, TurningLeftRunsTheRightWheelForward) {
  const WheelPair wheels = wheels_of({0.0, 1.0}, {.wheel_radius_m = 0.1, .track_m = 0.5});
  EXPECT_DOUBLE_EQ(wheels.right_radps, 2.5);
  EXPECT_DOUBLE_EQ(wheels.left_radps, -2.5);
}

TEST(Unicycle, ForwardTurnsBothWheelsAlike) {
  const WheelPair wheels = wheels_of({2.0, 0.0}, {.wheel_radius_m = 0.1, .track_m = 0.5});
  EXPECT_DOUBLE_EQ(wheels.left_radps, 20.0);
  EXPECT_DOUBLE_EQ(wheels.right_radps, 20.0);
}

TEST(Unicycle, JacobianIsTheDerivativeOfTheMotion) {
  // A body at the origin that moves for a short time: its displacement in b over the time is its twist in b.
  const double dt = 1e-7;
  const std::array<double, 12> eJe = unicycle_jacobian();
  for (int column = 0; column < 2; ++column) {
    const double forward = column == 0 ? 1.0 : 0.0;
    const double turn = column == 1 ? 1.0 : 0.0;
    const std::array<double, 6> twist{
        forward * std::cos(turn * dt / 2), forward * std::sin(turn * dt / 2), 0, 0, 0, turn};
    for (int row = 0; row < 6; ++row) EXPECT_NEAR(eJe[row * 2 + column], twist[row], 1e-6) << row << " " << column;
  }
  for (int row = 0; row < 6; ++row) EXPECT_EQ(turning_jacobian()[row], eJe[row * 2 + 1]);
}

}  // namespace
}  // namespace hogline::servo::test
