#include "servo/vanishing_point_task.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

AlignmentConfig constant_gain(double gain_per_s, double pitch_deg, double yaw_deg) {
  AlignmentConfig config = thrower_config().alignment;
  config.near_cRb = camera_rotation(pitch_deg * degree, yaw_deg * degree);
  config.gain_at_zero_per_s = gain_per_s;
  config.gain_at_infinity_per_s = gain_per_s;
  return config;
}

struct Mount {
  const char* description;
  double pitch_deg;
  double yaw_deg;
};

class VanishingPointLaw_ : public testing::TestWithParam<Mount> {};

// The task's error falls exponentially with the gain: near the target the rate is gain times the heading error.
TEST_P(VanishingPointLaw_, TurnsTheBodyByGainTimesError) {
  const double target = 2.0 * degree;
  VanishingPointTask task(constant_gain(3.0, GetParam().pitch_deg, GetParam().yaw_deg), target);
  for (const double error_deg : {-8.0, -1.0, -0.01, 0.01, 1.0, 8.0}) {
    const VanishingPointLaw law = task.law(target - error_deg * degree);
    ASSERT_TRUE(law.ok) << law.reason;
    const double tolerance = 0.12 * std::abs(error_deg) * degree * 3.0;
    EXPECT_NEAR(law.yaw_rate_radps, 3.0 * error_deg * degree, tolerance) << error_deg;
  }
}

INSTANTIATE_TEST_SUITE_P(Mounts, VanishingPointLaw_,
                         testing::Values(Mount{"level", 0.0, 0.0}, Mount{"looks down as the rig's", 28.0, 0.0},
                                         Mount{"looks down and left", 28.0, 10.0},
                                         Mount{"looks up a little and right", -3.0, -10.0}),
                         [](const auto& param) {
                           std::string name = param.param.description;
                           for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

TEST(VanishingPointTask, AtTheTargetNothingTurns) {
  VanishingPointTask task(constant_gain(3.0, 28.0, 0.0), 1.0 * degree);
  EXPECT_NEAR(task.law(1.0 * degree).yaw_rate_radps, 0.0, 1e-12);
}

TEST(VanishingPointTask, RefusesWhatItCanNotSee) {
  VanishingPointTask task(constant_gain(3.0, 28.0, 0.0), 0.0);
  for (const double heading : {120.0 * degree, -150.0 * degree, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()}) {
    const VanishingPointLaw law = task.law(heading);
    EXPECT_FALSE(law.ok);
    EXPECT_FALSE(law.reason.empty());
  }
  EXPECT_TRUE(task.law(0.05).ok) << "recovers once the heading is good";
}

TEST(VanishingPointTask, SurvivesBeingMoved) {
  VanishingPointTask first(constant_gain(3.0, 28.0, 0.0), 0.0);
  VanishingPointTask second(std::move(first));
  EXPECT_NEAR(second.law(-0.01).yaw_rate_radps, 0.03, 1e-3);
}

}  // namespace
}  // namespace hogline::servo::test
