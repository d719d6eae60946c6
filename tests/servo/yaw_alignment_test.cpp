#include "servo/yaw_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

/// A body that follows the ordered rate with a lag.
struct Body {
  double yaw_rad = 0.0;
  double rate_radps = 0.0;
  void move(double ordered_radps) {
    rate_radps += (ordered_radps - rate_radps) * seconds(period) / 0.03;
    yaw_rad += rate_radps * seconds(period);
  }
};

TEST(YawAlignment, KeepsToRateAndAcceleration) {
  const ThrowerConfig config = thrower_config();
  YawAlignment alignment(config.alignment, config.limits, 0.0);
  Body body{0.6, 0.0};
  double before = 0.0;
  for (int i = 0; i < 1200; ++i) {
    const AlignmentStep step = alignment.step(body.yaw_rad, body.rate_radps, period);
    ASSERT_TRUE(step.ok);
    EXPECT_LE(std::abs(step.yaw_rate_radps), config.limits.max_yaw_rate_radps + 1e-12);
    EXPECT_LE(std::abs(step.yaw_rate_radps - before),
              config.limits.max_yaw_acceleration_radps2 * seconds(period) + 1e-12);
    before = step.yaw_rate_radps;
    body.move(step.yaw_rate_radps);
    EXPECT_GT(body.yaw_rad, -0.2 * degree) << "no overshoot";
  }
  EXPECT_TRUE(alignment.step(body.yaw_rad, body.rate_radps, period).settled);
}

TEST(YawAlignment, ABodyWithinToleranceIsLeftAlone) {
  const ThrowerConfig config = thrower_config();
  YawAlignment alignment(config.alignment, config.limits, 0.0);
  for (int i = 0; i < 100; ++i) {
    const double noise = (i % 2 == 0 ? 0.9 : -0.9) * config.alignment.tolerance_rad;
    const AlignmentStep step = alignment.step(noise, 0.0, period);
    EXPECT_EQ(step.yaw_rate_radps, 0.0);
    EXPECT_EQ(step.settled, i * period >= config.alignment.settle_time - period);
  }
}

TEST(YawAlignment, ATurnIsNeverTooSlowToBreakAway) {
  const ThrowerConfig config = thrower_config();
  YawAlignment alignment(config.alignment, config.limits, 0.0);
  const AlignmentStep first = alignment.step(1.5 * config.alignment.tolerance_rad, 0.0, period);
  AlignmentStep step = first;
  for (int i = 0; i < 5; ++i) step = alignment.step(1.5 * config.alignment.tolerance_rad, 0.0, period);
  EXPECT_NEAR(step.yaw_rate_radps, -config.alignment.breakaway_yaw_rate_radps, 1e-12);
  EXPECT_FALSE(step.settled);
}

TEST(YawAlignment, MotionStartsTheSettleTimeAnew) {
  const ThrowerConfig config = thrower_config();
  YawAlignment alignment(config.alignment, config.limits, 0.0);
  for (int i = 0; i < 100; ++i) alignment.step(0.0, 0.0, period);
  ASSERT_TRUE(alignment.step(0.0, 0.0, period).settled);
  EXPECT_FALSE(alignment.step(0.0, 2.0 * config.alignment.rate_tolerance_radps, period).settled);
  EXPECT_FALSE(alignment.step(0.0, 0.0, period).settled);
}

TEST(YawAlignment, WhatIsNotANumberOrdersNothing) {
  const ThrowerConfig config = thrower_config();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [heading, rate] : {std::pair{nan, 0.0}, std::pair{0.1, nan}, std::pair{2.5, 0.0}}) {
    YawAlignment alignment(config.alignment, config.limits, 0.0);
    const AlignmentStep step = alignment.step(heading, rate, period);
    EXPECT_FALSE(step.ok);
    EXPECT_FALSE(step.reason.empty());
    EXPECT_EQ(step.yaw_rate_radps, 0.0);
  }
}

}  // namespace
}  // namespace hogline::servo::test
