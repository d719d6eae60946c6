#include "servo/line_tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

TEST(ShotLine, LeftIsPositive) {
  const ShotLine straight{0.1, -3.0, 0.0};
  EXPECT_NEAR(straight.lateral_m(0.0, 2.0), 0.1, 1e-12) << "x grows to the right";
  const ShotLine left{0.0, 0.0, 0.1};
  EXPECT_NEAR(left.lateral_m(-std::sin(0.1), std::cos(0.1)), 0.0, 1e-12) << "on the line";
  EXPECT_LT(left.lateral_m(0.0, 1.0), 0.0) << "straight on is right of a line that leads left";
}

TEST(LateralFilter, OdometryCarriesAndLooksCorrect) {
  LateralFilter filter({0.0, 0.0, 0.0}, thrower_config().odometry, 0.0, 0.003);
  for (int i = 0; i < 200; ++i) filter.advance(2.0, 0.01, 0.001, seconds(period));
  EXPECT_NEAR(filter.lateral_m(), 2.0 * std::sin(0.01), 1e-9);
  const double before = filter.variance_m2();
  SheetPosePercept pose;
  pose.ok = true;
  pose.body = {-0.018, 2.0, 0.01};
  pose.sigma = {0.003, 0.003, 0.002};
  EXPECT_TRUE(filter.correct(pose));
  EXPECT_NEAR(filter.lateral_m(), 0.019, 0.001);
  EXPECT_LT(filter.variance_m2(), before);
  pose.body.x_m = 1.0;
  EXPECT_FALSE(filter.correct(pose)) << "gated";
}

struct Case {
  double speed_mps;
  double heading_rad;
  double lateral_m;
  double curvature_per_m;  // what unequal wheels do
};

class LineTrackingLoop : public testing::TestWithParam<Case> {};

// A body with a lag of 40 ms, 12 m or 15 s of way: comes to the line without swinging and stays.
TEST_P(LineTrackingLoop, ComesToTheLineWithoutSwinging) {
  const Case& start = GetParam();
  const ThrowerConfig config = thrower_config();
  LineTracking tracking(config.run, config.limits, 0.0);
  double heading = start.heading_rad;
  double lateral = start.lateral_m;
  double rate = 0.0;
  double least = lateral;
  double greatest = lateral;
  const double dt = seconds(period);
  const double end_s = std::max(12.0 / start.speed_mps, 15.0);
  for (double t = 0.0; t < end_s; t += dt) {
    const double ordered = tracking.step(lateral, heading, start.speed_mps, 100.0, period);
    EXPECT_LE(std::abs(ordered), config.limits.max_yaw_rate_radps + 1e-12);
    rate += (ordered - rate) * dt / 0.04;
    heading += (rate + start.curvature_per_m * start.speed_mps) * dt;
    lateral += start.speed_mps * std::sin(heading) * dt;
    least = std::min(least, lateral);
    greatest = std::max(greatest, lateral);
  }
  EXPECT_NEAR(lateral, 0.0, 0.004);
  EXPECT_NEAR(heading, 0.0, 0.05 * degree);
  if (start.curvature_per_m != 0.0 || start.heading_rad != 0.0) return;
  EXPECT_GT(least, -0.15 * start.lateral_m) << "overshoot";
  EXPECT_LE(greatest, start.lateral_m + 1e-9);
}

INSTANTIATE_TEST_SUITE_P(SpeedsAndStarts, LineTrackingLoop,
                         testing::Values(Case{0.2, 0.0, 0.03, 0.0}, Case{1.0, 0.0, 0.05, 0.0},
                                         Case{2.1, 0.0, 0.05, 0.0}, Case{3.5, 0.0, 0.05, 0.0},
                                         Case{0.2, 0.02, 0.0, 0.0}, Case{2.1, -0.02, 0.0, 0.0},
                                         Case{3.5, 0.02, 0.0, 0.0}, Case{0.5, 0.0, 0.0, 0.01},
                                         Case{2.1, 0.0, 0.0, 0.02}, Case{3.5, 0.0, 0.0, -0.02}));

TEST(LineTracking, BeforeTheReleaseOnlyTheHeadingCounts) {
  const ThrowerConfig config = thrower_config();
  LineTracking tracking(config.run, config.limits, 0.1);
  EXPECT_EQ(tracking.step(0.05, 0.1, 2.0, 0.1, period), 0.0);
}

}  // namespace
}  // namespace hogline::servo::test
