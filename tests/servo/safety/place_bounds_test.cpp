#include "servo/safety/place_bounds.hpp"

#include <gtest/gtest.h>

#include "tests/servo/safety/supervised.hpp"

namespace hogline::servo::test {
namespace {

struct Drive {
  LineRobot robot{.speed_mps = 2.0};
  PlaceBounds bounds{robot.config.safety};
  void go(int periods, bool sees, double look_error_m = 0.0) {
    for (int i = 0; i < periods; ++i) {
      robot.move();
      bounds.wheels(robot.now, robot.speed_mps * (1.0 + robot.wheel_error));
      if (!sees || i % 3 != 0) continue;
      robot.look(look_error_m);
      bounds.look(*robot.low);
    }
  }
  bool contain_truth() const {
    return bounds.now()->nearest_m <= robot.hog_distance_m && robot.hog_distance_m <= bounds.now()->farthest_m;
  }
};

TEST(PlaceBounds, KnowNothingBeforeTheFirstLook) {
  Drive run;
  run.go(20, false);
  EXPECT_FALSE(run.bounds.now());
  EXPECT_FALSE(run.bounds.ahead(0.1, 1.0));
  EXPECT_NEAR(run.bounds.travelled_m(), 0.19, 0.001);
}

TEST(PlaceBounds, GrowWithTheWayAndShrinkWithALook) {
  Drive run;
  run.go(10, true);
  const double seen_m = run.bounds.now()->half_width_m();
  run.go(100, false);
  const double blind_m = run.bounds.now()->half_width_m();
  EXPECT_NEAR(blind_m - seen_m, 1.0 * run.robot.config.safety.odometry_bound, 0.005);
  EXPECT_TRUE(run.contain_truth());
  run.go(4, true);  // two looks
  EXPECT_NEAR(run.bounds.now()->half_width_m(), 4.0 * 0.003 + 0.02, 0.002);
  EXPECT_TRUE(run.contain_truth());
}

// Each tells of one side what the other does not: both are believed, so what they have in common is.
TEST(PlaceBounds, TakeWhatTheyKnewAndWhatIsSeenHaveInCommon) {
  Drive run;
  run.go(10, true);
  run.go(100, false);
  const double blind_m = run.bounds.now()->half_width_m();
  for (int i = 0; i < 2; ++i) {
    run.go(1, false);
    run.robot.look(0.8 * blind_m, 0.275 * blind_m);  // wider than what the wheels have carried here, off to one side
    run.bounds.look(*run.robot.low);
  }
  EXPECT_LT(run.bounds.now()->half_width_m(), 0.9 * blind_m);
  EXPECT_TRUE(run.contain_truth());
}

TEST(PlaceBounds, ALateLookActsAtItsOwnMoment) {
  Drive run;
  run.go(10, true);
  run.robot.look(0.0);
  const SheetPosePercept late = *run.robot.low;
  run.go(20, false);
  run.bounds.look(late);
  EXPECT_TRUE(run.contain_truth());
  EXPECT_NEAR(run.bounds.now()->farthest_m - run.robot.hog_distance_m, 0.032, 0.01);
}

TEST(PlaceBounds, ASlipIsFoundDoubtedAndOvercome) {
  Drive run;
  run.go(30, true);
  run.robot.wheel_error = 0.5;
  run.go(24, false);  // the wheels count 12 cm that are not there
  run.robot.wheel_error = 0.0;
  run.go(1, true);
  EXPECT_TRUE(run.bounds.in_doubt());
  EXPECT_TRUE(run.contain_truth());
  run.go(30, true);
  EXPECT_FALSE(run.bounds.in_doubt());
  EXPECT_LT(run.bounds.now()->half_width_m(), 0.04);
  EXPECT_TRUE(run.contain_truth());
}

TEST(PlaceBounds, OneWildLookChangesNothingAndManyAreCounted) {
  Drive run;
  run.go(30, true);
  run.go(1, true, 2.0);
  EXPECT_EQ(run.bounds.contradictions(), 1);
  EXPECT_TRUE(run.contain_truth());
  run.go(3, true);
  EXPECT_EQ(run.bounds.contradictions(), 0);
  run.go(30, true, -1.0);
  EXPECT_EQ(run.bounds.contradictions(), 10);
  EXPECT_TRUE(run.contain_truth());
}

TEST(PlaceBounds, AheadCoversWhatSpeedAndItsChangeAllow) {
  Drive run;
  run.go(30, true);
  const auto ahead = *run.bounds.ahead(0.08, 1.0);
  for (const double acceleration : {-1.0, 0.0, 1.0}) {
    const double there = run.robot.hog_distance_m - 2.0 * 0.08 - 0.5 * acceleration * 0.08 * 0.08;
    EXPECT_LE(ahead.nearest_m, there);
    EXPECT_GE(ahead.farthest_m, there);
  }
}

}  // namespace
}  // namespace hogline::servo::test
