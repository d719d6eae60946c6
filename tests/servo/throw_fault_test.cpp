// Faults in every state of a throw: the robot stops, the stone stays, and nothing moves again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "servo/release.hpp"
#include "tests/servo/rig.hpp"
#include "tests/servo/throw_harness.hpp"

namespace hogline::servo::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

struct Fault {
  const char* name;
  unsigned states;  // bit n: found in state n
  void (*spoil)(ThrowerObservation&);
};

constexpr unsigned in(ThrowerState state) { return 1u << static_cast<unsigned>(state); }
constexpr unsigned standing = in(ThrowerState::measure) | in(ThrowerState::align) | in(ThrowerState::fold);
constexpr unsigned throwing = standing | in(ThrowerState::run);
constexpr unsigned anywhere = throwing | in(ThrowerState::unfold) | in(ThrowerState::release) | in(ThrowerState::brake);
constexpr unsigned driving = throwing | in(ThrowerState::release) | in(ThrowerState::brake);
constexpr unsigned looking_near = in(ThrowerState::measure) | in(ThrowerState::align);

SheetPosePercept broken_look(Stamp now) {
  SheetPosePercept p;
  p.ok = true;
  p.stamp = now;
  p.sigma = {0.01, 0.01, 0.001};
  p.hog_distance_sigma_m = 0.01;
  p.hog_distance_m = nan;
  return p;
}

using O = ThrowerObservation;
constexpr auto second = std::chrono::seconds(1);
const Fault faults[] = {
    {"device_error", anywhere, [](O& o) { o.device_error = "right wheel: heartbeat lost"; }},
    {"wheels_absent", driving, [](O& o) { o.wheels.reset(); }},
    {"wheels_stale", anywhere, [](O& o) { o.wheels->stamp -= second; }},
    {"wheels_from_the_future", anywhere, [](O& o) { o.wheels->stamp += second; }},
    {"wheels_nan", anywhere, [](O& o) { o.wheels->left_radps = nan; }},
    {"wheels_inf", anywhere, [](O& o) { o.wheels->right_radps = inf; }},
    {"wheels_impossible", anywhere, [](O& o) { o.wheels->right_radps = 1e4; }},
    {"wheels_not_enabled", driving & ~in(ThrowerState::measure), [](O& o) { o.wheels->enabled = false; }},
    {"gyro_absent", driving, [](O& o) { o.gyro.reset(); }},
    {"gyro_stale", driving, [](O& o) { o.gyro->stamp -= second; }},
    {"gyro_nan", anywhere, [](O& o) { o.gyro->rate_radps = nan; }},
    {"gyro_out_of_range", anywhere, [](O& o) { o.gyro->rate_radps = -7.0; }},
    {"gyro_invalid", driving, [](O& o) { o.gyro->valid = false; }},
    {"gyro_disagrees", in(ThrowerState::align) | in(ThrowerState::fold) | in(ThrowerState::run),
     [](O& o) { o.gyro->rate_radps += 0.5; }},
    {"gripper_absent", throwing | in(ThrowerState::release), [](O& o) { o.gripper.reset(); }},
    {"gripper_stale", throwing | in(ThrowerState::unfold) | in(ThrowerState::release),
     [](O& o) { o.gripper->stamp -= second; }},
    {"gripper_nan", anywhere, [](O& o) { o.gripper->spin_radps = nan; }},
    {"stone_lost", throwing, [](O& o) { o.gripper->holding = false; }},
    {"jaws_open", throwing, [](O& o) { o.gripper->open = true; }},
    {"spin_lost", in(ThrowerState::run), [](O& o) { o.gripper->spin_radps = 0.0; }},
    {"arm_stale", throwing | in(ThrowerState::unfold), [](O& o) { o.arm->stamp -= second; }},
    {"arm_up", in(ThrowerState::run), [](O& o) { o.arm->folded = false; }},
    {"near_view_nan", anywhere, [](O& o) { o.near_view = broken_look(o.now); }},
    {"near_view_frozen", looking_near, [](O& o) { o.near_view.reset(); }},
    {"low_view_nan", anywhere, [](O& o) { o.low_view = broken_look(o.now); }},
    {"low_view_stale", in(ThrowerState::run), [](O& o) { o.low_view->stamp -= second; }},
    {"low_view_absent", in(ThrowerState::fold) | in(ThrowerState::run), [](O& o) { o.low_view.reset(); }},
    {"time_goes_back", anywhere, [](O& o) { o.now -= second; }},
};

const ThrowerState states[] = {ThrowerState::unfold, ThrowerState::measure, ThrowerState::align, ThrowerState::fold,
                               ThrowerState::run,    ThrowerState::release, ThrowerState::brake};

class ThrowFault : public testing::TestWithParam<std::tuple<ThrowerState, Fault>> {};

void expect_nothing_moves_after(const Outcome& o, Stamp found, bool stone_kept) {
  const Moment* before = nullptr;
  for (const Moment& moment : o.moments) {
    if (moment.now < found) continue;
    EXPECT_TRUE(moment.state == ThrowerState::brake || moment.state == ThrowerState::stopped);
    EXPECT_TRUE(moment.command.drive.order == DriveOrder::quick_stop || moment.command.drive.order == DriveOrder::off);
    EXPECT_EQ(moment.command.arm, ArmOrder::hold);
    EXPECT_EQ(moment.command.gripper.spin_radps, 0.0);
    EXPECT_FALSE(stone_kept && moment.command.gripper.release);
    // Two commands are still under way to the drives; then the body only slows down.
    if (before && moment.now > found + 3 * period) {
      EXPECT_LE(std::abs(moment.truth.speed_mps), std::abs(before->truth.speed_mps) + 1e-12);
    }
    before = &moment;
  }
  EXPECT_EQ(o.moments.back().truth.speed_mps, 0.0);
  EXPECT_EQ(o.moments.back().truth.yaw_rate_radps, 0.0);
}

/// The reason names the device at fault, or the state that waited for it in vain.
void expect_named(const std::string& reason, const std::string& fault) {
  std::string device = fault.substr(0, fault.find('_'));
  if (device == "stone" || device == "jaws") device = "gripper";
  if (device == "time") device = "control period: time goes back";
  EXPECT_TRUE(reason.find(device) != std::string::npos || reason.find("deadline") != std::string::npos) << reason;
}

// The fault lasts half a second, then all is well again: that must not bring the throw back to life.
TEST_P(ThrowFault, StopsTheRobotForGood) {
  const auto& [state, fault] = GetParam();
  std::optional<Stamp> since;
  std::optional<Stamp> found;
  const Spoil spoil = [&, wanted = state, change = fault.spoil](ThrowerObservation& o, const Thrower& thrower) {
    const bool there = thrower.state() == wanted && o.now - thrower.history().back().since >= 3 * period;
    if (!since && there) since = o.now;
    if (!found && thrower.abort_reason()) found = o.now;
    const bool lasting = since && (o.now - *since < std::chrono::milliseconds(500) || !found);
    if (lasting) change(o);
  };
  const Outcome o = throw_stone(thrower_config(), draw(), plain_settings(), spoil, 25.0);
  ASSERT_TRUE(since) << "the state was reached";
  ASSERT_TRUE(o.abort);
  ASSERT_TRUE(found);
  EXPECT_TRUE(o.finished);
  expect_named(*o.abort, fault.name);
  const bool kept = state != ThrowerState::release && state != ThrowerState::brake;
  EXPECT_EQ(o.jaws_opened, !kept);
  expect_nothing_moves_after(o, *found, kept);
  if (state == ThrowerState::run) {
    EXPECT_GT(stone_distance_m(o.moments.back().truth.hog_distance_m, 0.0, thrower_config().release), 0.145)
        << "early in the run the brakes suffice";
  }
}

std::vector<std::tuple<ThrowerState, Fault>> table() {
  std::vector<std::tuple<ThrowerState, Fault>> cases;
  for (const ThrowerState state : states) {
    for (const Fault& fault : faults) {
      if ((fault.states & in(state)) != 0) cases.emplace_back(state, fault);
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Table, ThrowFault, testing::ValuesIn(table()), [](const auto& param) {
  return std::string(to_string(std::get<0>(param.param))) + "_" + std::get<1>(param.param).name;
});

struct Stuck {
  const char* description;
  ThrowerState state;
  void (*hold)(ThrowerObservation&);
};

class Deadline : public testing::TestWithParam<Stuck> {};

TEST_P(Deadline, EndsAStateThatGetsNowhere) {
  const Spoil spoil = [](ThrowerObservation& o, const Thrower& thrower) {
    if (thrower.state() == GetParam().state) GetParam().hold(o);
  };
  const Outcome o = throw_stone(thrower_config(), draw(), plain_settings(), spoil, 30.0);
  ASSERT_TRUE(o.abort);
  EXPECT_NE(o.abort->find(std::string("deadline of ") + to_string(GetParam().state)), std::string::npos) << *o.abort;
  EXPECT_TRUE(o.finished);
}

INSTANTIATE_TEST_SUITE_P(
    States, Deadline,
    testing::Values(Stuck{"arm does not unfold", ThrowerState::unfold, [](O& o) { o.arm->unfolded = false; }},
                    Stuck{"no gyro", ThrowerState::unfold, [](O& o) { o.gyro.reset(); }},
                    Stuck{"no wheels", ThrowerState::unfold, [](O& o) { o.wheels.reset(); }},
                    Stuck{"nothing seen", ThrowerState::measure, [](O& o) { o.near_view.reset(); }},
                    Stuck{"not enabled", ThrowerState::measure, [](O& o) { o.wheels->enabled = false; }},
                    Stuck{"looks that see nothing", ThrowerState::align, [](O& o) { o.near_view->ok = false; }},
                    Stuck{"arm does not fold", ThrowerState::fold, [](O& o) { o.arm->folded = false; }},
                    Stuck{"stone does not spin", ThrowerState::fold, [](O& o) { o.gripper->spin_radps = 0.0; }},
                    Stuck{"stands still", ThrowerState::run,
                          [](O& o) {
                            o.wheels->left_radps = o.wheels->right_radps = 0.0;
                            o.gyro->rate_radps = 0.0;
                            o.low_view->ok = false;
                          }}),
    [](const auto& param) {
      std::string name = param.param.description;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });

TEST(ThrowRefused, ARunThatDoesNotFitIsNotBegun) {
  PlantSettings settings = plain_settings();
  settings.hog_distance_m = 5.0;
  ShotOrder order = draw();
  order.speed_mps = 3.3;
  const Outcome o = throw_stone(thrower_config(), order, settings);
  ASSERT_TRUE(o.abort);
  EXPECT_NE(o.abort->find("does not fit"), std::string::npos) << *o.abort;
  EXPECT_FALSE(o.reached(ThrowerState::run));
  EXPECT_FALSE(o.jaws_opened);
  for (const Moment& moment : o.moments) EXPECT_EQ(moment.truth.speed_mps, 0.0);
}

TEST(ThrowRefused, ABadOrderMovesNothing) {
  ShotOrder order = draw();
  order.speed_mps = nan;
  const Outcome o = throw_stone(thrower_config(), order, plain_settings(), {}, 3.0);
  ASSERT_TRUE(o.abort);
  EXPECT_TRUE(o.finished);
  for (const Moment& moment : o.moments) EXPECT_NE(moment.command.drive.order, DriveOrder::velocity);
}

// Without one look at the line the place at the release is not known well enough: the robot gives up while its brakes
// still stop it, stone in the jaws, before the line.
TEST(PointOfNoReturn, ABlindRunIsGivenUpBeforeTheLine) {
  for (const double speed : {1.91, 2.54, 3.3}) {
    PlantSettings settings = plain_settings();
    settings.visible_from_m = 0.0;
    settings.radius_error = 0.03;  // more than the robot believes
    ShotOrder order = draw();
    order.speed_mps = speed;
    const Outcome o = throw_stone(thrower_config(), order, settings);
    ASSERT_TRUE(o.abort);
    const bool unseen = o.abort->find("must be in sight") != std::string::npos;
    EXPECT_TRUE(unseen || o.abort->find("no valid release") != std::string::npos) << *o.abort;
    EXPECT_FALSE(o.jaws_opened);
    EXPECT_GT(stone_distance_m(o.moments.back().truth.hog_distance_m, 0.0, thrower_config().release), 0.145) << speed;
  }
}

// A fast run can not be stopped any more soon after the line has come into sight: the first few looks must do.
TEST(PointOfNoReturn, ALineThatJustCameIntoSightIsEnough) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    PlantSettings settings = plain_settings(seed);
    settings.visible_from_m = 4.2;
    settings.low_hog_sigma_m = 0.03;
    ShotOrder order = draw();
    order.speed_mps = 3.3;
    const Outcome o = throw_stone(thrower_config(), order, settings);
    EXPECT_FALSE(o.abort) << *o.abort;
    EXPECT_TRUE(o.released);
  }
}

TEST(PointOfNoReturn, ADragThatTheDriveDoesNotOvercomeIsGivenUp) {
  const Spoil spoil = [](ThrowerObservation& o, const Thrower& thrower) {
    if (thrower.state() != ThrowerState::run) return;
    o.wheels->left_radps *= 0.9;
    o.wheels->right_radps *= 0.9;
  };
  const Outcome o = throw_stone(thrower_config(), draw(), plain_settings(), spoil);
  ASSERT_TRUE(o.abort);
  EXPECT_FALSE(o.jaws_opened);
}

TEST(ReleaseState, JawsThatDoNotOpenAreToldToHold) {
  PlantSettings settings = plain_settings();
  settings.gripper_delay_s = 10.0;
  const Outcome o = throw_stone(thrower_config(), draw(), settings);
  ASSERT_TRUE(o.abort);
  EXPECT_NE(o.abort->find("deadline of release"), std::string::npos) << *o.abort;
  EXPECT_FALSE(o.released);
  EXPECT_FALSE(o.moments.back().command.gripper.release);
}

// A fault found in any period around the release: before the order the stone stays, after it the jaws go on opening.
TEST(ReleaseState, AFaultAroundTheReleaseNeverOrdersIt) {
  const Outcome well = throw_stone(thrower_config(), draw(), plain_settings());
  Stamp ordered{};
  for (const StateEntry& entry : well.history) {
    if (entry.state == ThrowerState::release) ordered = entry.since;
  }
  for (int i = -15; i <= 15; ++i) {
    const Stamp at = ordered + i * period;
    const Spoil spoil = [at](ThrowerObservation& o, const Thrower&) {
      if (o.now >= at) o.device_error = "arm: gone";
    };
    const Outcome o = throw_stone(thrower_config(), draw(), plain_settings(), spoil);
    ASSERT_TRUE(o.abort);
    EXPECT_EQ(o.jaws_opened, i > 0) << i;
    EXPECT_EQ(o.released, i > 0) << i;
    EXPECT_EQ(o.moments.back().truth.speed_mps, 0.0);
  }
}

TEST(Sight, ALowViewThatContradictsTheWheelsStopsTheRun) {
  const Spoil spoil = [](ThrowerObservation& o, const Thrower& thrower) {
    if (thrower.state() == ThrowerState::run && o.low_view) o.low_view->hog_distance_m += 1.5;
  };
  const Outcome o = throw_stone(thrower_config(), draw(), plain_settings(), spoil);
  ASSERT_TRUE(o.abort);
  EXPECT_NE(o.abort->find("disagree on the distance"), std::string::npos) << *o.abort;
  EXPECT_FALSE(o.jaws_opened);
}

}  // namespace
}  // namespace hogline::servo::test
