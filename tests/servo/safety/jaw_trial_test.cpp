// The stone set down in the hack and taken up again: what the supervisor lets pass of it, and what not.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <functional>

#include "tests/servo/safety/supervised.hpp"

namespace hogline::servo::test {
namespace {

/// A robot in the hack whose drives are without power.
struct HackRobot : LineRobot {
  std::optional<Stamp> opening_since = std::nullopt;
  std::optional<Stamp> freed_at = std::nullopt;

  ThrowerObservation observe_hack() const {
    ThrowerObservation o = observe();
    o.wheels->enabled = false;
    o.wheels->ready = true;
    o.gripper->spin_radps = 0.0;
    o.gripper->opening_since = opening_since;
    o.gripper->freed_at = freed_at;
    return o;
  }
  static ThrowerCommand order(JawTrial trial) {
    ThrowerCommand command;
    command.gripper.trial = trial;
    return command;
  }
};

Supervisor armed_in_hack(HackRobot& robot) {
  Supervisor supervisor(robot.config);
  robot.look(0.0);
  EXPECT_FALSE(supervisor.arm(robot.observe_hack()));
  return supervisor;
}

JawTrial permitted(Supervisor& supervisor, const HackRobot& robot, JawTrial trial) {
  return supervisor.permit(robot.observe_hack(), HackRobot::order(trial), period).gripper.trial;
}

/// One trial: the stone is free `delay_s` after the order, and held again later.
void try_jaws(Supervisor& supervisor, HackRobot& robot, double delay_s) {
  ASSERT_EQ(permitted(supervisor, robot, JawTrial::open), JawTrial::open) << *supervisor.reason();
  const Stamp free = robot.now + from_seconds(delay_s);
  while (robot.now < free) {
    robot.move();
    ASSERT_EQ(permitted(supervisor, robot, JawTrial::open), JawTrial::open) << *supervisor.reason();
  }
  robot.held = false;
  robot.opening_since = robot.freed_at = free;
  robot.move();
  ASSERT_EQ(permitted(supervisor, robot, JawTrial::grip), JawTrial::grip) << *supervisor.reason();
  EXPECT_TRUE(supervisor.set_down());
  for (int i = 0; i < 20; ++i) {
    robot.move();
    ASSERT_EQ(permitted(supervisor, robot, JawTrial::grip), JawTrial::grip) << *supervisor.reason();
  }
  robot.held = true;
  robot.opening_since.reset();
  robot.move();
  permitted(supervisor, robot, JawTrial::none);
  EXPECT_FALSE(supervisor.set_down());
}

TEST(JawTrials, PassInTheHackAndTheRunAfterThem) {
  HackRobot robot;
  Supervisor supervisor = armed_in_hack(robot);
  try_jaws(supervisor, robot, 0.08);
  try_jaws(supervisor, robot, 0.082);
  robot.move();
  EXPECT_TRUE(moves(supervisor.permit(robot.observe(), robot.drive(), period))) << *supervisor.reason();
  EXPECT_FALSE(supervisor.released()) << "a stone that is set down is not delivered";
}

struct Forbidden {
  const char* reason;
  std::function<void(HackRobot&, Supervisor&, ThrowerObservation&, ThrowerCommand&)> change;
};

class NoTrial : public testing::TestWithParam<Forbidden> {};

TEST_P(NoTrial, LatchesAndTheJawsStayShut) {
  HackRobot robot;
  Supervisor supervisor = armed_in_hack(robot);
  ThrowerObservation seen = robot.observe_hack();
  ThrowerCommand wanted = HackRobot::order(JawTrial::open);
  GetParam().change(robot, supervisor, seen, wanted);
  EXPECT_EQ(supervisor.permit(seen, wanted, period).gripper.trial, JawTrial::none);
  ASSERT_EQ(supervisor.state(), Supervision::latched);
  EXPECT_NE(supervisor.reason()->find(GetParam().reason), std::string::npos) << *supervisor.reason();
}

using R = HackRobot&;
using S = Supervisor&;
using O = ThrowerObservation&;
using C = ThrowerCommand&;
INSTANTIATE_TEST_SUITE_P(
    Table, NoTrial,
    testing::Values(Forbidden{"without power", [](R, S, O o, C) { o.wheels->enabled = true; }},
                    Forbidden{"without power",
                              [](R, S, O o, C) { o.wheels->left_radps = o.wheels->right_radps = 0.3; }},
                    Forbidden{"ordered to move", [](R, S, O, C c) { c.drive.order = DriveOrder::enable; }},
                    Forbidden{"ordered to move",
                              [](R robot, S supervisor, O o, C) {
                                supervisor.permit(robot.observe(), robot.drive(), period);
                                robot.move();
                                o = robot.observe_hack();
                              }},
                    Forbidden{"else is to move", [](R, S, O, C c) { c.arm = ArmOrder::unfold; }},
                    Forbidden{"else is to move", [](R, S, O, C c) { c.gripper.spin_radps = 1.0; }},
                    Forbidden{"place is not known", [](R, S, O o, C) { o.low_view.reset(); }},
                    Forbidden{"not in the hack",
                              [](R robot, S, O o, C) {
                                robot.hog_distance_m = 6.9;  // the stone's rim is over the tee line
                                robot.look(0.0);
                                o.low_view = robot.low;
                              }},
                    Forbidden{"release refused", [](R, S, O, C c) { c.gripper.release = true; }},
                    Forbidden{"gone", [](R, S, O o, C) { o.device_error = "gone"; }}));

TEST(JawTrials, NothingMovesWhileTheStoneStands) {
  const auto orders = [](const HackRobot& robot) {
    ThrowerCommand arm;
    arm.arm = ArmOrder::fold;
    ThrowerCommand belt;
    belt.gripper.spin_radps = 1.0;
    ThrowerCommand enable;
    enable.drive.order = DriveOrder::enable;
    return std::vector<ThrowerCommand>{robot.drive(), arm, belt, enable};
  };
  for (std::size_t i = 0; i < orders(HackRobot{}).size(); ++i) {
    HackRobot robot;
    Supervisor supervisor = armed_in_hack(robot);
    ASSERT_EQ(permitted(supervisor, robot, JawTrial::open), JawTrial::open) << *supervisor.reason();
    robot.move();  // the jaws have not yet said that they open
    EXPECT_FALSE(moves(supervisor.permit(robot.observe_hack(), orders(robot)[i], period))) << i;
    EXPECT_EQ(supervisor.state(), Supervision::latched);
  }
}

TEST(JawTrials, TheReleasesBoundsAreThoseOfTheJawsThatWereTried) {
  HackRobot robot;
  robot.config.release.gripper_delay_s = 0.03;
  JawWatch watch(robot.config.release);
  EXPECT_LT(watch.delay().most_s, 0.04) << "by the rig's word";
  for (const double delay_s : {0.081, 0.078}) {
    watch.permitted(JawTrial::open, robot.now);
    ThrowerObservation o = robot.observe_hack();
    o.gripper->freed_at = robot.now + from_seconds(delay_s);
    o.gripper->open = true;
    o.gripper->holding = false;
    watch.observe(o);
    watch.observe(robot.observe_hack());
    robot.now += std::chrono::seconds(1);
  }
  EXPECT_FALSE(watch.set_down());
  EXPECT_LT(watch.delay().least_s, 0.078);
  EXPECT_GT(watch.delay().least_s, 0.065);
  EXPECT_GT(watch.delay().most_s, 0.081);
  EXPECT_LT(watch.delay().most_s, 0.095);
}

TEST(JawTrialLaw, NoTrialPassesOnceTheDrivesWereLetMove) {
  EXPECT_TRUE(rc::check([] {
    HackRobot robot;
    Supervisor supervisor = armed_in_hack(robot);
    bool drove = false;
    for (int i = 0; i < 20; ++i) {
      robot.move();
      ThrowerCommand wanted = HackRobot::order(static_cast<JawTrial>(*rc::gen::inRange(0, 2)));
      if (*rc::gen::inRange(0, 6) == 0) wanted.drive.order = DriveOrder::enable;
      const ThrowerCommand out = supervisor.permit(robot.observe_hack(), wanted, period);
      if (out.gripper.trial == JawTrial::open) RC_ASSERT(!drove && out.drive.order == DriveOrder::off);
      if (out.drive.order == DriveOrder::enable) RC_ASSERT(!supervisor.set_down());
      drove = drove || out.drive.order == DriveOrder::enable;
    }
  }));
}

}  // namespace
}  // namespace hogline::servo::test
