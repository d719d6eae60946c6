// One sheet between two rinks: what the thrower lets go is what runs towards the skip.
#include "hw/sim/team_rink.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hw/sim/stone_motion.hpp"
#include "src/throwing/throw_judge.hpp"
#include "tests/src/team/practice_team.hpp"

namespace hogline::test {
namespace {

using hw::sim::from_other_end;
using hw::sim::StoneTruth;
using hw::sim::TeamRink;

struct World {
  explicit World(std::uint64_t seed)
      : request(practice_team(seed)),
        robot(with_small_pictures(request.thrower), request.scenario, 1),
        skip(with_small_pictures(request.skip), request.scenario, 1),
        rink(robot.rink(), skip.rink(), request.scenario.robot, seed) {}

  void run_devices() {
    const ThrowerDevices d = robot.devices();
    for (int i = 0; i < 400; ++i) {
      rink.step(period);
      d.drive.step(rink.now());
      d.gripper.step(rink.now());
      d.arm.step(rink.now());
      d.gyro.step(rink.now());
    }
  }
  /// To the robot's standstill.
  void throw_stone(const servo::ShotOrder& order) {
    OracleSeer oracle = oracle_of(robot, request.thrower);
    ThrowerLoop loop(robot.devices(), ThrowerEyes(oracle, request.thrower.looks),
                     servo::Thrower(request.thrower.thrower, order, rink.now()),
                     servo::Supervisor(request.thrower.thrower));
    loop.arm(rink.now());
    while (!loop.thrower().finished()) {
      const Stamp end = rink.now() + period;
      if (const auto due = loop.release_due(); due && *due < end) {
        if (*due > rink.now()) rink.step(*due - rink.now());
        loop.let_go(rink.now());
      }
      if (rink.now() < end) rink.step(end - rink.now());
      loop.step(rink.now(), period);
    }
    EXPECT_EQ(loop.thrower().abort_reason().value_or(""), "");
    robot.devices().drive.quick_stop();
    run_devices();
  }

  static constexpr Duration period = std::chrono::milliseconds(5);
  TeamRequest request;
  SimulatedRobot robot;
  SimulatedSkip skip;
  TeamRink rink;
};

constexpr servo::ShotOrder draw{.speed_mps = 2.1, .heading_rad = -0.02, .spin_radps = 1.5, .release_x_m = 0.19};

TEST(TeamRink, SeenFromTheOtherEndTwiceIsTheSame) {
  const StoneTruth stone{.x_m = 0.3, .y_m = 6.1, .vx_mps = -0.02, .vy_mps = 2.0, .spin_radps = 1.5, .handle_rad = 0.4};
  const StoneTruth there = from_other_end(stone);
  EXPECT_NEAR(there.y_m, 34.747 - 6.1, 1e-12);
  EXPECT_NEAR(there.vy_mps, -2.0, 1e-12);
  const StoneTruth back = from_other_end(there);
  EXPECT_NEAR(back.x_m, stone.x_m, 1e-12);
  EXPECT_NEAR(back.vx_mps, stone.vx_mps, 1e-12);
  EXPECT_EQ(back.spin_radps, stone.spin_radps);
  EXPECT_NEAR(std::remainder(back.handle_rad - stone.handle_rad, 2.0 * std::numbers::pi), 0.0, 1e-12);
}

TEST(TeamRink, TheReleasedStoneRunsToTheSkip) {
  World world(3);
  world.run_devices();
  world.rink.put_back(1);
  world.throw_stone(draw);
  const auto& truth = world.robot.rink().truth();
  ASSERT_TRUE(truth.release && world.rink.thrown());
  EXPECT_NEAR(truth.release->stone_x_m, 0.19, 0.02) << "let go where it was ordered";

  // The same stone by itself, from the recorded release on, with the throw's own friction.
  const auto& r = *truth.release;
  StoneTruth alone = from_other_end({.x_m = r.stone_x_m,
                                     .y_m = r.stone_y_m,
                                     .vx_mps = -r.speed_mps * std::sin(r.heading_rad),
                                     .vy_mps = r.speed_mps * std::cos(r.heading_rad),
                                     .spin_radps = r.spin_radps});
  while (world.rink.stone_runs()) world.rink.step(World::period);
  while (hw::sim::moves(alone)) hw::sim::slide(alone, world.rink.field().ice(), 1e-3);
  const auto& thrown = world.rink.field().stones()[*world.rink.thrown()];
  EXPECT_NEAR(thrown.motion.x_m, alone.x_m, 2e-3);
  EXPECT_NEAR(thrown.motion.y_m, alone.y_m, 0.02) << "a millisecond of friction";
  EXPECT_EQ(thrown.team, 1);
  EXPECT_NEAR(world.robot.rink().truth().stone.y_m, 34.747 - thrown.motion.y_m, 1e-9) << "the thrower's world agrees";
}

TEST(TeamRink, ThePersonPutsRobotAndNextStoneBack) {
  World world(4);
  world.run_devices();
  world.rink.put_back(0);
  world.throw_stone(draw);
  while (world.rink.stone_runs()) world.run_devices();
  world.rink.put_back(1);
  const auto& truth = world.robot.rink().truth();
  const auto& start = world.request.scenario.robot;
  EXPECT_NEAR(truth.body.x_m, start.start_x_m, 0.05);
  EXPECT_NEAR(truth.body.y_m, start.start_y_m, 0.05);
  EXPECT_FALSE(truth.release || truth.held);
  ASSERT_EQ(truth.others.size(), 1U) << "the first stone lies where it came to rest, for the thrower's cameras too";

  // Open jaws close on the new stone, and it can be thrown.
  world.robot.devices().gripper.grip();
  world.run_devices();
  EXPECT_EQ(world.robot.devices().gripper.state().jaws, hw::JawState::holding);
  EXPECT_TRUE(world.robot.rink().truth().held);
  world.throw_stone(draw);
  ASSERT_TRUE(world.rink.thrown());
  EXPECT_EQ(world.rink.field().stones().size(), 2U);
  while (world.rink.stone_runs()) world.rink.step(World::period);
  EXPECT_FALSE(world.rink.field().contacts().empty()) << "the same shot again meets the first stone";
}

}  // namespace
}  // namespace hogline::test
