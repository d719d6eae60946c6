#include "servo/braking.hpp"

#include <gtest/gtest.h>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

double rests_at_m(double speed_mps, double rest_m) {
  ThrowerConfig config = thrower_config();
  config.release.rest_hog_distance_m = rest_m;
  double hog_m = config.release.hog_distance_m;
  while (speed_mps > 0.0) {
    const double a = braking_mps2(speed_mps, hog_m, config.release, config.limits);
    EXPECT_LE(a, config.limits.max_deceleration_mps2);
    EXPECT_GE(a, least_braking_mps2);
    hog_m -= speed_mps * seconds(period);
    speed_mps -= a * seconds(period);
  }
  return hog_m;
}

TEST(Braking, ComesToRestWhereItShall) {
  for (const double speed : {1.9, 2.3, 2.8, 3.3}) EXPECT_NEAR(rests_at_m(speed, -3.0), -3.0, 0.03) << speed;
}

TEST(Braking, APlaceTooNearIsOverrunAtTheLimitAndOneTooFarIsNotReached) {
  const ThrowerConfig config = thrower_config();
  const double shortest_m = 3.0 * 3.0 / (2.0 * config.limits.max_deceleration_mps2);
  EXPECT_NEAR(rests_at_m(3.0, 0.2), config.release.hog_distance_m - shortest_m, 0.03);
  EXPECT_GT(rests_at_m(1.0, -10.0), -1.0) << "it must brake harder than the ice brakes the stone";
}

}  // namespace
}  // namespace hogline::servo::test
