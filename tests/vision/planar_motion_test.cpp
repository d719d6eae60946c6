// How a body's last places carry it on.
#include "vision/planar_motion.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hogline::vision {
namespace {

Stamp at(double t_s) { return Stamp{from_seconds(t_s)}; }

TEST(PlanarMotion, StandsStillUntilItsVelocityIsKnown) {
  PlanarMotion motion;
  EXPECT_TRUE(motion.empty());
  motion.add(at(0.0), {1.0, 2.0, 0.1});
  motion.add(at(0.1), {1.1, 2.0, 0.1});
  EXPECT_FALSE(motion.known());
  EXPECT_EQ(motion.at(at(0.5)).x_m, 1.1);
  motion.clear();
  EXPECT_TRUE(motion.empty());
}

TEST(PlanarMotion, CarriesAConstantVelocityOnExactlyWhateverTheSteps) {
  PlanarMotion motion;
  const auto body = [](double t_s) { return PlanarPose{0.3 - 0.2 * t_s, -3.0 + 1.5 * t_s, 0.1 + 0.35 * t_s}; };
  for (const double t_s : {0.0, 0.016, 0.05, 0.06, 0.1, 0.13}) motion.add(at(t_s), body(t_s));
  ASSERT_TRUE(motion.known());
  const PlanarPose next = motion.at(at(0.2));
  EXPECT_NEAR(next.x_m, body(0.2).x_m, 1e-9);
  EXPECT_NEAR(next.y_m, body(0.2).y_m, 1e-9);
  EXPECT_NEAR(next.yaw_rad, body(0.2).yaw_rad, 1e-9);
}

TEST(PlanarMotion, TurnsThroughHalfATurn) {
  PlanarMotion motion;
  constexpr double pi = std::numbers::pi;
  motion.add(at(0.0), {0.0, 0.0, pi - 0.03});
  motion.add(at(0.1), {0.0, 0.0, pi - 0.01});
  motion.add(at(0.2), {0.0, 0.0, -pi + 0.01});
  EXPECT_NEAR(motion.at(at(0.3)).yaw_rad, -pi + 0.03, 1e-9);
}

TEST(PlanarMotion, ForgetsAllButTheLastPlaces) {
  PlanarMotion motion;
  for (int k = 0; k < 20; ++k) motion.add(at(0.1 * k), {100.0 * k, 0.0, 0.0});
  for (int k = 20; k < 24; ++k) motion.add(at(0.1 * k), {5.0, 0.0, 0.0});
  EXPECT_NEAR(motion.at(at(3.0)).x_m, 5.0, 1e-9);
}

}  // namespace
}  // namespace hogline::vision
