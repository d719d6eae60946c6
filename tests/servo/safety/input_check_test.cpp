#include "servo/safety/input_check.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "servo/refusal.hpp"
#include "servo/safety/latch.hpp"
#include "servo/safety/turn_agreement.hpp"
#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

const Stamp now = Stamp(std::chrono::seconds(100));
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
const InputNeeds all{true, true, true, true, true, true, true, true};

SheetPosePercept seen() {
  SheetPosePercept p;
  p.ok = true;
  p.stamp = now - std::chrono::milliseconds(20);
  p.body = {0.0, 1.0, 0.01};
  p.sigma = {0.01, 0.01, 0.001};
  p.hog_distance_m = 5.4;
  p.hog_distance_sigma_m = 0.01;
  return p;
}

ThrowerObservation good() {
  ThrowerObservation o;
  o.now = now;
  o.wheels = WheelObservation{now, 1.0, 1.0, false, true};
  o.gyro = GyroObservation{now, 0.01, true};
  o.gripper = GripperObservation{now, true, false, 0.0, {}, {}};
  o.arm = ArmObservation{now, true, false};
  o.near_view = seen();
  o.low_view = seen();
  return o;
}

struct Case {
  const char* reason;
  std::function<void(ThrowerObservation&)> spoil;
};

class BadInput : public testing::TestWithParam<Case> {};

TEST_P(BadInput, IsFound) {
  ThrowerObservation o = good();
  ASSERT_FALSE(bad_input(o, period, all, thrower_config()));
  GetParam().spoil(o);
  const auto reason = bad_input(o, period, all, thrower_config());
  ASSERT_TRUE(reason) << GetParam().reason;
  EXPECT_NE(reason->find(GetParam().reason), std::string::npos) << *reason;
}

using O = ThrowerObservation;
INSTANTIATE_TEST_SUITE_P(
    Table, BadInput,
    testing::Values(Case{"device", [](O& o) { o.device_error = "left wheel: heartbeat lost"; }},
                    Case{"wheels: nothing", [](O& o) { o.wheels.reset(); }},
                    Case{"wheels: stale", [](O& o) { o.wheels->stamp -= std::chrono::milliseconds(21); }},
                    Case{"wheels: stamp lies", [](O& o) { o.wheels->stamp += std::chrono::milliseconds(21); }},
                    Case{"wheels: speed is not", [](O& o) { o.wheels->left_radps = nan; }},
                    Case{"wheels: speed is not", [](O& o) { o.wheels->right_radps = -inf; }},
                    Case{"wheels: speed is impossible", [](O& o) { o.wheels->right_radps = 71.0; }},
                    Case{"wheels: not enabled", [](O& o) { o.wheels->enabled = false; }},
                    Case{"gyro: nothing", [](O& o) { o.gyro.reset(); }},
                    Case{"gyro: stale", [](O& o) { o.gyro->stamp -= std::chrono::milliseconds(31); }},
                    Case{"gyro: marked", [](O& o) { o.gyro->valid = false; }},
                    Case{"gyro: rate is not", [](O& o) { o.gyro->rate_radps = nan; }},
                    Case{"gyro: rate is out", [](O& o) { o.gyro->rate_radps = 6.6; }},
                    Case{"gripper: nothing", [](O& o) { o.gripper.reset(); }},
                    Case{"gripper: stale", [](O& o) { o.gripper->stamp -= std::chrono::milliseconds(151); }},
                    Case{"gripper: spin", [](O& o) { o.gripper->spin_radps = inf; }},
                    Case{"gripper: the stone", [](O& o) { o.gripper->holding = false; }},
                    Case{"gripper: the stone", [](O& o) { o.gripper->open = true; }},
                    Case{"arm: nothing", [](O& o) { o.arm.reset(); }},
                    Case{"arm: stale", [](O& o) { o.arm->stamp -= std::chrono::milliseconds(301); }},
                    Case{"arm: folded and", [](O& o) { o.arm->unfolded = true; }},
                    Case{"near view: nothing", [](O& o) { o.near_view.reset(); }},
                    Case{"near view: stale", [](O& o) { o.near_view->stamp -= std::chrono::milliseconds(101); }},
                    Case{"near view: pose is not finite", [](O& o) { o.near_view->body.yaw_rad = nan; }},
                    Case{"near view: pose is not on", [](O& o) { o.near_view->body.x_m = 50.0; }},
                    Case{"near view: yaw", [](O& o) { o.near_view->body.yaw_rad = 4.0; }},
                    Case{"near view: sigma", [](O& o) { o.near_view->sigma.x_m = 0.0; }},
                    Case{"low view: stale", [](O& o) { o.low_view->stamp -= std::chrono::milliseconds(101); }},
                    Case{"low view: pose is not finite", [](O& o) { o.low_view->hog_distance_m = inf; }},
                    Case{"low view: pose is not on", [](O& o) { o.low_view->hog_distance_m = -46.0; }},
                    Case{"low view: sigma", [](O& o) { o.low_view->hog_distance_sigma_m = nan; }}));

TEST(BadInput, WhatIsNotNeededMayBeOldOrAbsent) {
  ThrowerObservation o;
  o.now = now;
  EXPECT_FALSE(bad_input(o, period, {}, thrower_config()));
  o = good();
  o.near_view->stamp -= std::chrono::seconds(10);
  InputNeeds needs = all;
  needs.near_view = false;
  EXPECT_FALSE(bad_input(o, period, needs, thrower_config()));
}

TEST(BadInput, NotSeeingIsNotAFault) {
  ThrowerObservation o = good();
  o.low_view->ok = false;
  o.low_view->hog_distance_m = nan;
  EXPECT_FALSE(bad_input(o, period, all, thrower_config()));
}

TEST(BadInput, TimeMustGoOnInSmallSteps) {
  for (const Duration dt : {Duration(0), Duration(-1), Duration(std::chrono::milliseconds(21))}) {
    EXPECT_TRUE(bad_input(good(), dt, all, thrower_config()));
  }
}

TEST(TurnAgreement, ForgivesAShortSlipAndNotALongOne) {
  const SafetyConfig config = thrower_config().safety;
  TurnAgreement agreement(config);
  for (int i = 0; i < 29; ++i) EXPECT_FALSE(agreement.judge(0.5, 0.0, period));
  EXPECT_FALSE(agreement.judge(0.0, 0.0, period));
  bool found = false;
  for (int i = 0; i < 31; ++i) found = found || agreement.judge(0.5, 0.0, period).has_value();
  EXPECT_TRUE(found);
  TurnAgreement fresh(config);
  for (int i = 0; i < 31; ++i) found = fresh.judge(nan, 0.0, period).has_value();
  EXPECT_TRUE(found) << "what is not a number does not agree";
}

TEST(Latch, KeepsTheFirstReason) {
  Latch latch;
  latch.set(std::nullopt);
  EXPECT_FALSE(latch.reason());
  latch.set("first");
  latch.set("second");
  latch.set(std::nullopt);
  EXPECT_EQ(*latch.reason(), "first");
}

struct Refused {
  const char* reason;
  void (*spoil)(ThrowerConfig&, ShotOrder&);
};

class Refusal : public testing::TestWithParam<Refused> {};

TEST_P(Refusal, BeforeAnythingMoves) {
  ThrowerConfig config = thrower_config();
  ShotOrder order = draw();
  ASSERT_FALSE(refusal(config, order));
  GetParam().spoil(config, order);
  const auto reason = refusal(config, order);
  ASSERT_TRUE(reason);
  EXPECT_NE(reason->find(GetParam().reason), std::string::npos) << *reason;
}

using C = ThrowerConfig;
using S = ShotOrder;
INSTANTIATE_TEST_SUITE_P(
    Table, Refusal,
    testing::Values(Refused{"wheel_radius_m", [](C& c, S&) { c.base.wheel_radius_m = 0.0; }},
                    Refused{"max_jerk", [](C& c, S&) { c.limits.max_jerk_mps3 = nan; }},
                    Refused{"ages.gyro", [](C& c, S&) { c.ages.gyro = {}; }},
                    Refused{"deadlines.release", [](C& c, S&) { c.deadlines.release = {}; }},
                    Refused{"gripper_delay_s", [](C& c, S&) { c.release.gripper_delay_s = -0.01; }},
                    Refused{"near_cRb", [](C& c, S&) { c.alignment.near_cRb = {}; }},
                    Refused{"near_cRb", [](C& c, S&) { c.alignment.near_cRb[0] = nan; }},
                    Refused{"near_cRb", [](C& c, S&) { c.alignment.near_cRb = {1, 0, 0, 0, 1, 0, 0, 0, -1}; }},
                    Refused{"stone's radius", [](C& c, S&) { c.release.hog_distance_m = 0.59; }},
                    Refused{"speed", [](C&, S& s) { s.speed_mps = 3.6; }},
                    Refused{"speed", [](C&, S& s) { s.speed_mps = 0.0; }},
                    Refused{"speed", [](C&, S& s) { s.speed_mps = nan; }},
                    Refused{"heading", [](C&, S& s) { s.heading_rad = nan; }},
                    Refused{"heading", [](C&, S& s) { s.heading_rad = 1.0; }},
                    Refused{"spin", [](C&, S& s) { s.spin_radps = -1.0; }}));

}  // namespace
}  // namespace hogline::servo::test
