#include "servo/safety/supervisor.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/servo/safety/supervised.hpp"

namespace hogline::servo::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Supervisor, NothingPassesBeforeArming) {
  LineRobot robot;
  Supervisor supervisor(robot.config);
  ThrowerCommand wanted = robot.let_go();
  wanted.arm = ArmOrder::unfold;
  const ThrowerCommand permitted = supervisor.permit(robot.observe(), wanted, period);
  EXPECT_FALSE(moves(permitted));
  EXPECT_FALSE(permitted.gripper.release);
  EXPECT_EQ(permitted.drive.order, DriveOrder::off);
  EXPECT_EQ(supervisor.state(), Supervision::disarmed);
}

struct Refused {
  const char* reason;
  std::function<void(ThrowerObservation&)> spoil;
};

TEST(Supervisor, ArmingIsRefusedWhereItMustBe) {
  const std::vector<Refused> cases{
      {"switch is not held", [](auto& o) { o.operator_switch->held = false; }},
      {"switch is not held", [](auto& o) { o.operator_switch.reset(); }},
      {"switch is not held", [](auto& o) { o.operator_switch->stamp -= std::chrono::seconds(1); }},
      {"switch is not held", [](auto& o) { o.operator_switch->stamp += std::chrono::seconds(1); }},
      {"left wheel", [](auto& o) { o.device_error = "left wheel: gone"; }},
      {"wheels turn", [](auto& o) { o.wheels->left_radps = 0.5; }},
      {"wheels turn", [](auto& o) { o.wheels->left_radps = nan; }},
      {"wheels turn", [](auto& o) { o.wheels->stamp -= std::chrono::seconds(1); }}};
  for (const Refused& refused : cases) {
    LineRobot robot;
    ThrowerObservation observation = robot.observe();
    refused.spoil(observation);
    Supervisor supervisor(robot.config);
    const auto reason = supervisor.arm(observation);
    ASSERT_TRUE(reason) << refused.reason;
    EXPECT_NE(reason->find(refused.reason), std::string::npos) << *reason;
    EXPECT_FALSE(moves(supervisor.permit(robot.observe(), robot.drive(), period)));
  }
}

class Stops : public testing::TestWithParam<Refused> {};

// One period of a run, all well but for one thing.
TEST_P(Stops, TheRunLatchedUntilArmedAnew) {
  LineRobot robot{.speed_mps = 1.0};
  Supervisor supervisor = armed(robot);
  for (int i = 0; i < 20; ++i) {
    robot.move();
    robot.look(0.0);
    ASSERT_TRUE(moves(supervisor.permit(robot.observe(), robot.drive(), period))) << *supervisor.reason();
  }
  for (int i = 0; i < 40 && supervisor.state() == Supervision::armed; ++i) {
    robot.move();
    robot.look(0.0);
    ThrowerObservation bad = robot.observe();
    GetParam().spoil(bad);
    supervisor.permit(bad, robot.drive(), period);
  }
  ASSERT_EQ(supervisor.state(), Supervision::latched);
  EXPECT_NE(supervisor.reason()->find(GetParam().reason), std::string::npos) << *supervisor.reason();

  const std::string first = *supervisor.reason();
  for (int i = 0; i < 20; ++i) {
    robot.move();
    robot.look(0.0);
    const ThrowerCommand permitted = supervisor.permit(robot.observe(), robot.let_go(), period);
    EXPECT_FALSE(moves(permitted));
    EXPECT_EQ(permitted.drive.order, DriveOrder::quick_stop);
    EXPECT_FALSE(permitted.gripper.release);
  }
  EXPECT_EQ(*supervisor.reason(), first);
  robot.speed_mps = 0.0;
  EXPECT_EQ(supervisor.permit(robot.observe(), robot.drive(), period).drive.order, DriveOrder::off);
  EXPECT_TRUE(supervisor.arm(robot.observe())) << "the switch has not been let go";
  ThrowerObservation open = robot.observe();
  open.operator_switch->held = false;
  supervisor.permit(open, {}, period);
  EXPECT_FALSE(supervisor.arm(robot.observe())) << "let go, and pressed again";
  EXPECT_TRUE(moves(supervisor.permit(robot.observe(), robot.drive(), period)));
}

using O = ThrowerObservation;
INSTANTIATE_TEST_SUITE_P(
    Table, Stops,
    testing::Values(Refused{"switch was let go", [](O& o) { o.operator_switch->held = false; }},
                    Refused{"switch was let go", [](O& o) { o.operator_switch.reset(); }},
                    Refused{"switch was let go", [](O& o) { o.operator_switch->stamp -= std::chrono::seconds(1); }},
                    Refused{"wheels: nothing", [](O& o) { o.wheels.reset(); }},
                    Refused{"wheels: stale", [](O& o) { o.wheels->stamp -= std::chrono::milliseconds(25); }},
                    Refused{"wheels: speed is not", [](O& o) { o.wheels->right_radps = nan; }},
                    Refused{"wheels: speed", [](O& o) { o.wheels->left_radps = o.wheels->right_radps = 40.0; }},
                    Refused{"wheels: rate of turn", [](O& o) { o.wheels->right_radps += 5.0; }},
                    Refused{"disagree", [](O& o) { o.gyro->rate_radps = 0.3; }},
                    Refused{"gyro: rate of turn", [](O& o) { o.gyro->rate_radps = 0.6; }},
                    Refused{"gyro: marked", [](O& o) { o.gyro->valid = false; }},
                    Refused{"gyro: stale", [](O& o) { o.gyro->stamp -= std::chrono::milliseconds(35); }},
                    Refused{"stone is not held", [](O& o) { o.gripper->holding = false; }},
                    Refused{"gripper: stale", [](O& o) { o.gripper->stamp -= std::chrono::milliseconds(200); }},
                    Refused{"low view: stale", [](O& o) { o.low_view->stamp -= std::chrono::milliseconds(200); }},
                    Refused{"low view: sigma", [](O& o) { o.low_view->hog_distance_sigma_m = -1.0; }},
                    Refused{"no rotation", [](O& o) { o.low_view->eMc[0] = nan; }},
                    Refused{"no rotation", [](O& o) { o.low_view->eMc = {}; }},
                    Refused{"tilted",
                            [](O& o) {
                              o.low_view->eMc = camera_pose(0.0, 4.0 * degree, thrower_config().safety.low_cRb);
                            }},
                    Refused{"contradict", [](O& o) { o.low_view->hog_distance_m += 1.0; }},
                    Refused{"device", [](O& o) { o.device_error = "jaws: gone"; }}));

TEST(Supervisor, ABodyThatRocksIsNotTilted) {
  LineRobot robot{.speed_mps = 1.0};
  Supervisor supervisor = armed(robot);
  robot.move();
  robot.look(0.0);
  robot.low->eMc = camera_pose(0.05, -0.5 * degree, robot.config.safety.low_cRb);
  EXPECT_TRUE(moves(supervisor.permit(robot.observe(), robot.drive(), period))) << *supervisor.reason();
}

TEST(Supervisor, OrdersBeyondTheLimitsAreNotCutButRefused) {
  for (const auto& [left, right] : {std::pair{50.0, 50.0}, std::pair{-2.0, 2.0}, std::pair{nan, 1.0}}) {
    LineRobot robot;
    Supervisor supervisor = armed(robot);
    ThrowerCommand wanted = robot.drive();
    wanted.drive.left_radps = left;
    wanted.drive.right_radps = right;
    EXPECT_FALSE(moves(supervisor.permit(robot.observe(), wanted, period)));
    EXPECT_EQ(supervisor.state(), Supervision::latched);
  }
}

TEST(Supervisor, BrakesWhileTheStoneCanStillBeKeptBeforeTheLine) {
  for (const double speed_mps : {0.5, 1.5, 2.5, 3.4}) {
    LineRobot robot{.hog_distance_m = 7.0, .speed_mps = speed_mps};
    Supervisor supervisor = armed(robot);
    for (int i = 0; i < 10; ++i) {
      robot.move();
      robot.look(0.0);
      supervisor.permit(robot.observe(), robot.drive(), period);
    }
    // Nothing is seen any more, and the wheels alone become too vague for a release.
    robot.low->ok = false;
    while (supervisor.state() == Supervision::armed && robot.stone_m() > 0.145) {
      robot.move();
      robot.low->stamp = robot.now;
      supervisor.permit(robot.observe(), robot.drive(), period);
    }
    ASSERT_EQ(supervisor.state(), Supervision::latched) << speed_mps;
    const double stopping_m = speed_mps * robot.config.safety.reaction_s +
                              speed_mps * speed_mps / (2.0 * robot.config.limits.max_deceleration_mps2);
    EXPECT_GE(robot.stone_m() - 0.145, stopping_m) << speed_mps << ": " << *supervisor.reason();
  }
}

TEST(Supervisor, AReleaseOnceLetPassStaysOrdered) {
  LineRobot robot{.hog_distance_m = 1.4, .speed_mps = 2.0};
  Supervisor supervisor = armed(robot);
  while (robot.hog_distance_m > robot.config.release.hog_distance_m + 2.0 * robot.config.release.gripper_delay_s) {
    robot.move();
    robot.look(0.0);
    ASSERT_TRUE(moves(supervisor.permit(robot.observe(), robot.drive(), period))) << *supervisor.reason();
  }
  ASSERT_TRUE(supervisor.permit(robot.observe(), robot.let_go(), period).gripper.release) << *supervisor.reason();
  robot.move();
  EXPECT_TRUE(supervisor.permit(robot.observe(), robot.drive(), period).gripper.release);
  ThrowerObservation bad = robot.observe();
  bad.device_error = "drive: gone";
  EXPECT_TRUE(supervisor.permit(bad, robot.drive(), period).gripper.release);
  EXPECT_EQ(supervisor.state(), Supervision::latched);
  EXPECT_TRUE(supervisor.permit(robot.observe(), {}, period).gripper.release);
}

TEST(Supervisor, AReleaseAtAWrongPlaceIsRefusedForGood) {
  for (const double hog_distance_m : {5.0, 1.4, 1.28, 1.0, 0.7, 0.5}) {
    LineRobot robot{.hog_distance_m = hog_distance_m + 0.01, .speed_mps = 2.0};
    Supervisor supervisor = armed(robot);
    robot.move();
    robot.look(0.0);
    const ThrowerCommand permitted = supervisor.permit(robot.observe(), robot.let_go(), period);
    EXPECT_FALSE(permitted.gripper.release) << hog_distance_m;
    EXPECT_EQ(supervisor.state(), Supervision::latched);
    EXPECT_FALSE(supervisor.permit(robot.observe(), robot.let_go(), period).gripper.release);
  }
}

TEST(Supervisor, TravelsNeitherTooFarNorBlindly) {
  LineRobot robot{.hog_distance_m = 40.0, .speed_mps = 2.0};
  Supervisor far = armed(robot);
  while (far.state() == Supervision::armed && robot.hog_distance_m > 20.0) {
    robot.move();
    robot.look(0.0);
    far.permit(robot.observe(), robot.drive(), period);
  }
  ASSERT_TRUE(far.reason());
  EXPECT_NE(far.reason()->find("carried the stone"), std::string::npos);

  LineRobot blind;
  Supervisor supervisor(blind.config);
  supervisor.arm(blind.observe());
  blind.speed_mps = 1.0;
  SheetPosePercept nothing;
  nothing.reason = "no line";
  blind.low = nothing;
  while (supervisor.state() == Supervision::armed && blind.hog_distance_m > 5.0) {
    blind.move();
    blind.low->stamp = blind.now;
    supervisor.permit(blind.observe(), blind.drive(), period);
  }
  ASSERT_TRUE(supervisor.reason());
  EXPECT_NE(supervisor.reason()->find("without having seen"), std::string::npos) << *supervisor.reason();
  EXPECT_GT(blind.hog_distance_m, 8.6);
}

TEST(Supervisor, StandsIdleWithoutJudgingWhenNothingIsWanted) {
  LineRobot robot;
  Supervisor supervisor = armed(robot);
  ThrowerObservation bad = robot.observe();
  bad.device_error = "drive: its set-points have ended";
  supervisor.permit(bad, {}, period);
  EXPECT_EQ(supervisor.state(), Supervision::armed);
}

}  // namespace
}  // namespace hogline::servo::test
