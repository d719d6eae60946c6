#include "servo/release.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

const Stamp start = Stamp(std::chrono::seconds(9));

double between(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

/// A body at a known distance with a known speed.
HogDistanceFilter moving(double hog_distance_m, double speed_mps, double sigma_m = 0.004) {
  OdometryConfig exact = thrower_config().odometry;
  exact.scale_sigma = 1e-4;
  HogDistanceFilter filter(exact, start - period, hog_distance_m + speed_mps * seconds(period) / 2.0, sigma_m);
  filter.odometry(start, speed_mps, 0.0);
  return filter;
}

ReleaseOutlook good(double speed_mps) {
  ReleaseOutlook outlook;
  outlook.now = start;
  outlook.dt = period;
  outlook.wanted_speed_mps = speed_mps;
  return outlook;
}

RC_GTEST_PROP(Release, IsOrderedAtTheWantedMomentWithinItsPeriod, ()) {
  const ThrowerConfig config = thrower_config();
  const double speed = between(1.5, 3.5);
  double distance = config.release.hog_distance_m + speed * (config.release.gripper_delay_s + between(0.02, 0.1));
  for (int i = 0; i < 100; ++i) {
    const ReleaseDecision decision = decide_release(config.release, config.run, moving(distance, speed), good(speed));
    RC_ASSERT(decision.verdict != ReleaseVerdict::never);
    if (decision.verdict == ReleaseVerdict::release) {
      const double freed_at = distance - speed * (seconds(decision.in) + config.release.gripper_delay_s);
      RC_ASSERT(decision.in >= Duration::zero() && decision.in < period);
      RC_ASSERT(std::abs(freed_at - config.release.hog_distance_m) <= 1e-6);
      return;
    }
    distance -= speed * seconds(period);
  }
  RC_FAIL("no release was ordered");
}

// Whatever the place, speed and heading: a stone that is let go comes free within the window and before the line.
RC_GTEST_PROP(Release, NeverOutsideTheWindowNorTooNearToTheLine, ()) {
  ThrowerConfig config = thrower_config();
  config.release.hog_distance_m = between(0.55, 1.2);
  config.release.tolerance_m = between(0.02, 0.3);
  const double speed = between(0.5, 3.5);
  const double distance = between(0.3, 1.6);
  ReleaseOutlook outlook = good(speed);
  outlook.heading_rad = between(-0.01, 0.01);
  const ReleaseDecision decision = decide_release(config.release, config.run, moving(distance, speed), outlook);
  if (decision.verdict != ReleaseVerdict::release) return;
  const double freed_at = distance - speed * (seconds(decision.in) + config.release.gripper_delay_s);
  RC_ASSERT(std::abs(freed_at - config.release.hog_distance_m) <= config.release.tolerance_m + 1e-9);
  RC_ASSERT(stone_distance_m(freed_at, outlook.heading_rad, config.release) >= stone_to_hog_line_m);
}

TEST(Release, AStateThatMissedTheWindowKeepsTheStone) {
  const ThrowerConfig config = thrower_config();
  const double past = config.release.hog_distance_m - config.release.tolerance_m - 0.01;
  const ReleaseDecision decision = decide_release(config.release, config.run, moving(past, 2.0), good(2.0));
  EXPECT_EQ(decision.verdict, ReleaseVerdict::never);
  EXPECT_NE(decision.reason.find("past the release plane"), std::string::npos) << decision.reason;
}

struct Fault {
  const char* reason;
  void (*spoil)(ReleaseOutlook&);
};

class ReleaseRefused : public testing::TestWithParam<Fault> {};

TEST_P(ReleaseRefused, AtTheRightPlace) {
  const ThrowerConfig config = thrower_config();
  const double now_at = config.release.hog_distance_m + 2.0 * config.release.gripper_delay_s;
  ReleaseOutlook outlook = good(2.0);
  ASSERT_EQ(decide_release(config.release, config.run, moving(now_at, 2.0), outlook).verdict, ReleaseVerdict::release);
  GetParam().spoil(outlook);
  const ReleaseDecision decision = decide_release(config.release, config.run, moving(now_at, 2.0), outlook);
  EXPECT_EQ(decision.verdict, ReleaseVerdict::never);
  EXPECT_NE(decision.reason.find(GetParam().reason), std::string::npos) << decision.reason;
}

INSTANTIATE_TEST_SUITE_P(Faults, ReleaseRefused,
                         testing::Values(Fault{"speed", [](ReleaseOutlook& o) { o.wanted_speed_mps = 2.3; }},
                                         Fault{"speed", [](ReleaseOutlook& o) { o.wanted_speed_mps = NAN; }},
                                         Fault{"heading", [](ReleaseOutlook& o) { o.wanted_heading_rad = 0.05; }},
                                         Fault{"heading", [](ReleaseOutlook& o) { o.wanted_heading_rad = NAN; }},
                                         Fault{"line", [](ReleaseOutlook& o) { o.lateral_m = -0.2; }},
                                         Fault{"line", [](ReleaseOutlook& o) { o.lateral_m = NAN; }},
                                         Fault{"spin", [](ReleaseOutlook& o) { o.spin_error_radps = -1.0; }},
                                         Fault{"spin", [](ReleaseOutlook& o) { o.spin_error_radps = NAN; }},
                                         Fault{"too near", [](ReleaseOutlook& o) { o.heading_rad = NAN; }}));

TEST(Release, APlaceThatIsNotKnownWellEnoughKeepsTheStone) {
  const ThrowerConfig config = thrower_config();
  const double now_at = config.release.hog_distance_m + 2.0 * config.release.gripper_delay_s;
  const auto decision = decide_release(config.release, config.run, moving(now_at, 2.0, 0.08), good(2.0));
  EXPECT_EQ(decision.verdict, ReleaseVerdict::never);
  EXPECT_NE(decision.reason.find("uncertain"), std::string::npos) << decision.reason;
}

TEST(Release, ABodyThatStandsWaits) {
  const ThrowerConfig config = thrower_config();
  EXPECT_EQ(decide_release(config.release, config.run, moving(1.0, 0.0), good(2.0)).verdict, ReleaseVerdict::wait);
}

}  // namespace
}  // namespace hogline::servo::test
