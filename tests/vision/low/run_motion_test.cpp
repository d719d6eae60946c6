#include "vision/run_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hogline::vision {
namespace {

Stamp at(int frame) { return Stamp{from_seconds(frame / 60.0)}; }

struct Course {
  const char* description;
  double speed_mps;
  double acceleration_mps2;
  double yaw_rate_radps;
};

RunPlace place_on(const Course& c, int frame) {
  const double t = frame / 60.0;
  return {.body = {.x_m = 0.1 - 0.02 * t,
                   .y_m = c.speed_mps * t + 0.5 * c.acceleration_mps2 * t * t,
                   .yaw_rad = 0.01 + c.yaw_rate_radps * t},
          .sigma = {.x_m = 0.001, .y_m = 0.001, .yaw_rad = 0.0002}};
}

TEST(RunMotion, CarriesOnAtConstantAcceleration) {
  for (const Course& c : {Course{"stands", 0.0, 0.0, 0.0}, Course{"constant speed", 2.6, 0.0, 0.0},
                          Course{"accelerates", 2.0, 0.8, 0.02}, Course{"brakes", 3.0, -0.8, -0.02}}) {
    SCOPED_TRACE(c.description);
    RunMotion motion;
    for (int k = 0; k < 20; ++k) motion.add(at(k), place_on(c, k));
    const RunPlace ahead = motion.at(at(27));
    EXPECT_NEAR(ahead.body.y_m, place_on(c, 27).body.y_m, 0.003);
    EXPECT_NEAR(ahead.body.x_m, place_on(c, 27).body.x_m, 1e-4);
    EXPECT_NEAR(ahead.body.yaw_rad, place_on(c, 27).body.yaw_rad, 2e-4);
    EXPECT_LT(std::abs(ahead.body.y_m - place_on(c, 27).body.y_m), ahead.sigma.y_m);
    EXPECT_NEAR(motion.speed_mps(at(19)), c.speed_mps + c.acceleration_mps2 * 19 / 60.0, 0.02);
  }
}

TEST(RunMotion, IsLessSureTheLongerNothingIsSeen) {
  RunMotion motion;
  for (int k = 0; k < 12; ++k) motion.add(at(k), place_on({"", 2.5, 0.0, 0.0}, k));
  double before_m = 0.0;
  for (int k = 11; k < 30; ++k) {
    const RunPlace there = motion.at(at(k));
    EXPECT_GT(there.sigma.y_m, before_m);
    before_m = there.sigma.y_m;
  }
}

TEST(RunMotion, ExpectsAnySpeedFromRestToFullWhereOnePlaceIsKnown) {
  RunMotion motion;
  EXPECT_TRUE(motion.empty());
  motion.add(at(0), place_on({"", 3.4, 0.0, 0.0}, 0));
  EXPECT_FALSE(motion.known());
  const RunPlace next = motion.at(at(1));
  for (const double speed : {0.0, 3.5}) {
    EXPECT_LT(std::abs(next.body.y_m - speed / 60.0), 2.0 * next.sigma.y_m) << speed;
  }
}

TEST(RunMotion, TakesTheSpeedFromTwoPlacesAsFarAsTheyTell) {
  for (const double speed : {0.0, 3.4}) {
    SCOPED_TRACE(speed);
    RunMotion sure;
    RunMotion unsure;
    for (int k = 0; k < 2; ++k) {
      RunPlace place = place_on({"", speed, 0.0, 0.0}, k);
      sure.add(at(k), place);
      place.sigma.y_m = 0.2;
      unsure.add(at(k), place);
    }
    EXPECT_NEAR(sure.speed_mps(at(1)), speed, 0.1);
    EXPECT_NEAR(unsure.speed_mps(at(1)), 1.75, 0.1) << "half of full speed, rather than one that noise invents";
  }
}

TEST(RunMotion, ForgetsWhatIsOld) {
  RunMotion motion;
  for (int k = 0; k < 5; ++k) motion.add(at(k), place_on({"", 1.0, 0.0, 0.0}, k));
  for (int k = 100; k < 106; ++k) motion.add(at(k), place_on({"", 3.0, 0.0, 0.0}, k));
  EXPECT_NEAR(motion.speed_mps(at(105)), 3.0, 0.01);
}

}  // namespace
}  // namespace hogline::vision
