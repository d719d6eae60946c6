// Laws of the simulated base.
#include "hw/sim/robot_dynamics.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/hw/sim/reference_scenario.hpp"

namespace hogline::hw::sim {
namespace {

constexpr double dt_s = 0.001;
constexpr double g = 9.80665;
constexpr double grip_share = 100.0 / 118.0;  // the stone of 18 kg lies on the ice and must be moved all the same

// Both axes ramp up with this acceleration of the rim for this long.
void ramp(RobotDynamics& robot, double rim_mps2, double span_s, double radius_m = 0.1) {
  const double start = robot.left_radps();
  const int steps = static_cast<int>(std::lround(span_s / dt_s));
  for (int i = 1; i <= steps; ++i) {
    const double axis = start + rim_mps2 * i * dt_s / radius_m;
    robot.step({axis, axis}, 18.0, 0.6, dt_s);
  }
}

void hold(RobotDynamics& robot, const AxisSpeeds& axes, double span_s) {
  for (int i = 0; i < static_cast<int>(std::lround(span_s / dt_s)); ++i) robot.step(axes, 18.0, 0.6, dt_s);
}

RC_GTEST_PROP(RobotDynamics, does_not_slip_below_the_traction_limit_and_slips_beyond_it, ()) {
  auto scenario = exact_scenario().robot;
  scenario.friction_coefficient = 0.01 * *rc::gen::inRange(5, 50);
  const double share = 0.01 * *rc::gen::inRange(10, 300);
  RC_PRE(std::abs(share - 1.0) > 0.02);
  RobotDynamics robot(scenario, 1);
  const double most = scenario.friction_coefficient * g * grip_share;
  ramp(robot, share * most, 0.5);
  RC_ASSERT(robot.slipping() == (share > 1.0));
  RC_ASSERT(robot.acceleration_mps2() <= most + 1e-9);
  RC_ASSERT(std::abs(robot.acceleration_mps2() - std::min(share, 1.0) * most) < 1e-6);
}

TEST(RobotDynamics, runs_straight_without_disturbance) {
  RobotDynamics robot(exact_scenario().robot, 1);
  ramp(robot, 0.5, 4.0);
  hold(robot, {20.0, 20.0}, 2.0);
  EXPECT_NEAR(robot.pose().x_m, 0.0, 1e-12);
  EXPECT_EQ(robot.pose().yaw_rad, 0.0);
  EXPECT_NEAR(robot.pose().y_m, -3.658 + 0.5 * 0.5 * 16.0 + 2.0 * 2.0, 1e-6);
  EXPECT_NEAR(robot.twist().forward_mps, 2.0, 1e-9);
}

TEST(RobotDynamics, forward_is_along_the_body_and_left_turns_are_positive) {
  auto scenario = exact_scenario().robot;
  scenario.start_yaw_rad = std::numbers::pi / 2.0;  // b's x axis points to e's -x
  RobotDynamics robot(scenario, 1);
  ramp(robot, 0.5, 2.0);
  EXPECT_NEAR(robot.pose().x_m, -1.0, 1e-6);
  EXPECT_NEAR(robot.pose().y_m, -3.658, 1e-6);
  RobotDynamics turning(exact_scenario().robot, 1);
  hold(turning, {-1.0, 1.0}, 1.0);
  EXPECT_NEAR(turning.twist().yaw_radps, 2.0 * 0.1 / 0.5, 1e-9);
  EXPECT_GT(turning.pose().yaw_rad, 0.0);
}

TEST(RobotDynamics, error_of_the_wheel_radius_scales_the_distance) {
  for (const double error : {-0.01, 0.003, 0.01}) {
    auto scenario = exact_scenario().robot;
    scenario.start_y_m = 0.0;
    RobotDynamics exact(scenario, 1);
    scenario.left_radius_error = scenario.right_radius_error = error;
    RobotDynamics wrong(scenario, 1);
    for (auto* robot : {&exact, &wrong}) {
      ramp(*robot, 0.5, 4.0);
      hold(*robot, {20.0, 20.0}, 1.0);
    }
    EXPECT_NEAR(wrong.pose().y_m / exact.pose().y_m, 1.0 + error, 1e-9) << error;
  }
}

TEST(RobotDynamics, error_of_the_track_scales_the_turn) {
  auto scenario = exact_scenario().robot;
  scenario.track_error = 0.02;
  RobotDynamics robot(scenario, 1);
  hold(robot, {-1.0, 1.0}, 1.0);
  EXPECT_NEAR(robot.twist().yaw_radps, 0.4 / 1.02, 1e-9);
}

TEST(RobotDynamics, unequal_radii_turn_the_robot_and_bias_of_the_steering_does_so_unseen) {
  auto scenario = exact_scenario().robot;
  scenario.right_radius_error = 0.001;
  RobotDynamics unequal(scenario, 1);
  ramp(unequal, 0.5, 4.0);
  EXPECT_NEAR(unequal.pose().yaw_rad, 4.0 * 0.001 / 0.5, 1e-5);

  scenario.right_radius_error = 0.0;
  scenario.steering_bias_rad_per_m = 0.002;
  RobotDynamics biased(scenario, 1);
  ramp(biased, 0.5, 4.0);
  EXPECT_NEAR(biased.pose().yaw_rad, 4.0 * 0.002, 1e-5);
  EXPECT_EQ(biased.left_radps(), biased.right_radps());
}

TEST(RobotDynamics, free_wheels_roll_out_and_never_roll_back) {
  RobotDynamics robot(exact_scenario().robot, 1);
  ramp(robot, 0.5, 2.0);
  hold(robot, {}, 5.0);
  EXPECT_NEAR(robot.twist().forward_mps, 1.0 - 0.01 * g * grip_share * 5.0, 1e-6);
  EXPECT_NEAR(robot.left_radps(), robot.twist().forward_mps / 0.1, 1e-9);
  EXPECT_FALSE(robot.slipping());
  hold(robot, {}, 10.0);
  EXPECT_NEAR(robot.twist().forward_mps, 0.0, 1e-9);
}

TEST(RobotDynamics, locked_wheels_brake_with_the_ice_alone) {
  auto scenario = exact_scenario().robot;
  scenario.friction_coefficient = 0.1;
  RobotDynamics robot(scenario, 1);
  ramp(robot, 0.5, 4.0);
  hold(robot, {0.0, 0.0}, 1.0);
  EXPECT_NEAR(robot.twist().forward_mps, 2.0 - 0.1 * g * grip_share, 1e-6);
  EXPECT_TRUE(robot.slipping());
}

TEST(RobotDynamics, one_wheel_alone_turns_the_robot_towards_the_other) {
  RobotDynamics robot(exact_scenario().robot, 1);
  hold(robot, {std::nullopt, 5.0}, 0.5);
  EXPECT_GT(robot.twist().yaw_radps, 0.0);
  EXPECT_GT(robot.twist().forward_mps, 0.0);
}

TEST(RobotDynamics, the_nose_rises_while_it_speeds_up_and_comes_back) {
  RobotDynamics robot(exact_scenario().robot, 1);
  ramp(robot, 0.5, 4.0);
  EXPECT_NEAR(robot.pitch_rad(), -0.004 * 0.5, 1e-5);
  hold(robot, {20.0, 20.0}, 0.166);
  EXPECT_GT(robot.pitch_rad(), 0.0) << "it rocks past its rest";
  hold(robot, {20.0, 20.0}, 5.0);
  EXPECT_NEAR(robot.pitch_rad(), 0.0, 1e-6);
}

TEST(RobotDynamics, the_wandering_has_its_stated_size_and_its_seed) {
  auto scenario = exact_scenario().robot;
  scenario.yaw_disturbance_radps = 0.01;
  const auto rates = [&](std::uint64_t seed) {
    RobotDynamics robot(scenario, seed);
    ramp(robot, 1.0, 2.0);
    std::vector<double> values;
    for (int i = 0; i < 400000; ++i) {
      robot.step({20.0, 20.0}, 18.0, 0.6, dt_s);
      values.push_back(robot.twist().yaw_radps);
    }
    return values;
  };
  const auto values = rates(3);
  double mean = 0.0;
  double square = 0.0;
  for (const double value : values) {
    mean += value / static_cast<double>(values.size());
    square += value * value / static_cast<double>(values.size());
  }
  EXPECT_NEAR(std::sqrt(square), 0.01, 0.0012);
  EXPECT_NEAR(mean, 0.0, 0.0015);
  EXPECT_EQ(values, rates(3));
  EXPECT_NE(values, rates(4));
}

TEST(RobotDynamics, a_wheel_that_pulls_creeps_in_proportion_to_its_pull) {
  auto scenario = exact_scenario().robot;
  scenario.creep = 0.03;
  for (const double acceleration : {0.2, 0.4, 0.8}) {
    RobotDynamics robot(scenario, 1);
    ramp(robot, acceleration, 4.0);
    const double slip = 1.0 - robot.twist().forward_mps / (robot.left_radps() * 0.1);
    EXPECT_NEAR(slip, 0.03 * acceleration / g / grip_share, 2e-5) << acceleration;
    EXPECT_FALSE(robot.slipping());
    hold(robot, {robot.left_radps(), robot.right_radps()}, 1.0);
    EXPECT_NEAR(robot.twist().forward_mps, robot.left_radps() * 0.1, 1e-6) << "nothing pulls any more";
  }
}

TEST(RobotDynamics, the_runner_takes_grip_from_the_wheels_and_more_while_braking) {
  auto scenario = exact_scenario().robot;
  scenario.runner_x_m = 0.7;
  scenario.mass_x_m = 0.07;
  scenario.friction_coefficient = 0.2;
  const auto limit = [&](double rim_mps2) {
    RobotDynamics robot(scenario, 1);
    hold(robot, {}, 0.01);
    ramp(robot, rim_mps2, 0.4);
    EXPECT_TRUE(robot.slipping());
    return std::abs(robot.acceleration_mps2());
  };
  const double plain = 0.2 * g * grip_share;
  EXPECT_NEAR(limit(5.0), 0.9 * plain, 1e-6);
  scenario.mass_z_m = 0.3;
  // Of N = W (1 - (x - z a / g) / L): the grip grows while it speeds up and falls while it brakes.
  EXPECT_NEAR(limit(5.0), 0.9 * plain / (1.0 - plain * 0.3 / (g * 0.7)), 1e-3);
  EXPECT_NEAR(limit(-5.0), 0.9 * plain / (1.0 + plain * 0.3 / (g * 0.7)), 1e-3);
}

}  // namespace
}  // namespace hogline::hw::sim
