#include "servo/speed_profile.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace hogline::servo::test {
namespace {

double between(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

RC_GTEST_PROP(SpeedProfile, StaysWithinItsLimitsAndArrives, ()) {
  const double speed = between(0.05, 4.0);
  const double acceleration = between(0.2, 3.0);
  const double jerk = between(0.5, 20.0);
  const SpeedProfile profile(speed, acceleration, jerk);
  const double duration = profile.duration_s();
  const double dt = duration / 400.0;
  double distance = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double t = i * dt;
    const double v0 = profile.speed_mps(t);
    const double v1 = profile.speed_mps(t + dt);
    RC_ASSERT(v1 >= v0 - 1e-12);
    RC_ASSERT((v1 - v0) / dt <= acceleration + 1e-9);
    RC_ASSERT(std::abs(profile.acceleration_mps2(t + dt) - profile.acceleration_mps2(t)) / dt <= jerk + 1e-6);
    distance += (v0 + 4.0 * profile.speed_mps(t + dt / 2.0) + v1) / 6.0 * dt;
  }
  RC_ASSERT(std::abs(profile.speed_mps(duration) - speed) < 1e-9);
  RC_ASSERT(std::abs(distance - profile.distance_m()) < 1e-3 * profile.distance_m());
}

RC_GTEST_PROP(SpeedProfile, SpeedIsContinuousAndAccelerationItsDerivative, ()) {
  const SpeedProfile profile(between(0.05, 4.0), between(0.2, 3.0), between(0.5, 20.0));
  const double t = between(0.0, 1.1) * profile.duration_s();
  const double h = 1e-5 * profile.duration_s();
  const double slope = (profile.speed_mps(t + h) - profile.speed_mps(t - h)) / (2.0 * h);
  RC_ASSERT(std::abs(slope - profile.acceleration_mps2(t)) < 1e-3);
}

TEST(SpeedProfile, RestsBeforeAndHoldsAfter) {
  const SpeedProfile profile(2.09, 1.0, 3.0);
  EXPECT_EQ(profile.speed_mps(-1.0), 0.0);
  EXPECT_EQ(profile.speed_mps(0.0), 0.0);
  EXPECT_EQ(profile.speed_mps(100.0), 2.09);
  EXPECT_EQ(profile.acceleration_mps2(100.0), 0.0);
}

TEST(SpeedProfile, AFastShotTakesTheKnownDistance) {
  const SpeedProfile profile(3.0, 1.0, 2.0);  // 0.5 s up, 2.5 s constant, 0.5 s down
  EXPECT_NEAR(profile.duration_s(), 3.5, 1e-12);
  EXPECT_NEAR(profile.distance_m(), 5.25, 1e-12);
}

TEST(StoppingDistance, IsReactionAndBraking) { EXPECT_DOUBLE_EQ(stopping_distance_m(2.0, 2.0, 0.1), 1.2); }

}  // namespace
}  // namespace hogline::servo::test
