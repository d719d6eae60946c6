// The stone: FCV1's checks, and its way from the jaws.
#include <gtest/gtest.h>

#include <cmath>

#include "hw/sim/stone_motion.hpp"
#include "hw/sim/world.hpp"
#include "tests/hw/sim/reference_scenario.hpp"

namespace hogline::hw::sim {
namespace {

using namespace std::chrono_literals;

constexpr double dt_s = 0.001;
constexpr double near_hog_m = 6.401;  // e's y, house-side edges
constexpr double far_hog_m = near_hog_m + 21.945;

struct Run {
  double hog_to_hog_s = 0.0;
  double to_rest_s = 0.0;
  double curl_m = 0.0;       ///< to the left
  double late_curl_m = 0.0;  ///< in the last six metres
  double travel_m = 0.0;
  double end_y_m = 0.0;
};

Run run_from_hog(double speed_mps, double spin_radps, const StoneScenario& scenario) {
  StoneTruth stone{.y_m = near_hog_m, .vy_mps = speed_mps, .spin_radps = spin_radps};
  Run run;
  std::vector<StoneTruth> path;
  while (std::hypot(stone.vx_mps, stone.vy_mps) > 0.0) {
    slide(stone, scenario, dt_s);
    run.to_rest_s += dt_s;
    if (stone.y_m < far_hog_m) run.hog_to_hog_s = run.to_rest_s;
    path.push_back(stone);
  }
  run.curl_m = -stone.x_m;
  run.end_y_m = stone.y_m;
  run.travel_m = stone.y_m - near_hog_m;
  for (const auto& place : path) {
    if (place.y_m > stone.y_m - 6.0) {
      run.late_curl_m = run.curl_m + place.x_m;
      break;
    }
  }
  return run;
}

TEST(StoneMotion, a_tee_draw_takes_the_times_of_the_reference) {
  const auto run = run_from_hog(2.09, 1.5, exact_scenario().stone);
  EXPECT_GE(run.hog_to_hog_s, 13.0);
  EXPECT_LE(run.hog_to_hog_s, 15.0);
  EXPECT_GE(run.to_rest_s, 23.0);
  EXPECT_LE(run.to_rest_s, 26.0);
  EXPECT_NEAR(run.end_y_m, 34.747, 1.0) << "near the far tee";
}

TEST(StoneMotion, curl_is_that_of_the_reference_and_most_of_it_comes_late) {
  const auto run = run_from_hog(2.09, 1.5, exact_scenario().stone);
  EXPECT_GE(run.curl_m, 0.8) << "counter-clockwise curls left";
  EXPECT_LE(run.curl_m, 1.5);
  EXPECT_GE(run.late_curl_m / run.curl_m, 0.35);
  EXPECT_LE(run.late_curl_m / run.curl_m, 0.55);
  EXPECT_NEAR(run_from_hog(2.09, -1.5, exact_scenario().stone).curl_m, -run.curl_m, 1e-9);
  EXPECT_EQ(run_from_hog(2.09, 0.0, exact_scenario().stone).curl_m, 0.0);
}

TEST(StoneMotion, shots_take_the_references_times_from_hog_to_hog) {
  const struct {
    const char* shot;
    double speed_mps;
    double time_s;
  } cases[] = {{"guard", 1.91, 17.6},      {"tee draw", 2.09, 13.8}, {"back line", 2.14, 13.2}, {"control", 2.32, 11.5},
               {"normal hit", 2.54, 10.0}, {"firm", 2.76, 9.0},      {"peel", 3.30, 7.2}};
  for (const auto& c : cases) {
    const auto run = run_from_hog(c.speed_mps, 1.5, exact_scenario().stone);
    EXPECT_NEAR(run.hog_to_hog_s, c.time_s, 0.02 * c.time_s + 0.15) << c.shot;
  }
}

TEST(StoneMotion, factors_of_the_session_scale_friction_and_curl) {
  auto scenario = exact_scenario().stone;
  const auto exact = run_from_hog(2.09, 1.5, scenario);
  scenario.friction_scale = 1.01;
  EXPECT_NEAR(exact.travel_m - run_from_hog(2.09, 1.5, scenario).travel_m, 0.28, 0.05) << "1 % is 0.28 m";
  scenario.friction_scale = 1.0;
  scenario.curl_gain = 1.1;
  EXPECT_NEAR(run_from_hog(2.09, 1.5, scenario).curl_m - exact.curl_m, 0.15, 0.05) << "10 % is 0.15 m";
  EXPECT_NEAR(run_from_hog(2.10, 1.5, exact_scenario().stone).travel_m - exact.travel_m, 0.295, 0.03) << "1 cm/s";
}

class Delivery {
 public:
  explicit Delivery(const Scenario& chosen) : scenario(chosen), world(chosen, Stamp{}) {}
  const Truth& truth() const { return world.truth(); }
  void drive_at(double left_radps, double right_radps, Duration span) {
    inputs.axes = {left_radps, right_radps};
    for (const Stamp end = now + span; now < end;) world.step(inputs, now += 5ms);
  }
  void speed_up_to(double speed_mps, double acceleration_mps2) {
    while (world.truth().twist.forward_mps < speed_mps - 1e-9) {
      axis = std::min(axis + acceleration_mps2 * 0.005 / 0.1, speed_mps / 0.1);
      drive_at(axis, axis, 5ms);
    }
  }
  Scenario scenario;
  World world;
  WorldInputs inputs;
  Stamp now{};
  double axis = 0.0;
};

TEST(World, carries_the_stone_rigidly) {
  auto scenario = exact_scenario();
  scenario.robot.start_yaw_rad = 0.3;
  Delivery delivery(scenario);
  delivery.inputs.belt_radps = 1.5;
  delivery.drive_at(-0.5, 1.0, 3s);
  const auto& truth = delivery.truth();
  EXPECT_TRUE(truth.held);
  EXPECT_NEAR(truth.stone.x_m - truth.body.x_m, -0.6 * std::sin(truth.body.yaw_rad), 1e-12);
  EXPECT_NEAR(truth.stone.y_m - truth.body.y_m, 0.6 * std::cos(truth.body.yaw_rad), 1e-12);
  EXPECT_NEAR(truth.stone.spin_radps, 1.5 + truth.twist.yaw_radps, 1e-12);
  EXPECT_NEAR(std::hypot(truth.stone.vx_mps, truth.stone.vy_mps),
              std::hypot(truth.twist.forward_mps, 0.6 * truth.twist.yaw_radps), 1e-12);
}

TEST(World, lets_the_stone_go_at_the_very_moment_with_the_robots_motion) {
  auto scenario = exact_scenario();
  scenario.robot.start_yaw_rad = -0.01;
  Delivery delivery(scenario);
  delivery.speed_up_to(2.09, 0.4);
  delivery.inputs.belt_radps = -1.5;
  const Stamp free_at = delivery.now + 12345678ns;
  const double y_before = delivery.truth().stone.y_m;
  delivery.inputs.stone_free_at = free_at;
  delivery.drive_at(delivery.axis, delivery.axis, 50ms);
  ASSERT_TRUE(delivery.truth().release);
  const auto& release = *delivery.truth().release;
  EXPECT_EQ(release.stamp, free_at);
  EXPECT_NEAR(release.stone_y_m - y_before, 2.09 * std::cos(0.01) * 0.012345678, 1e-9);
  EXPECT_NEAR(release.speed_mps, 2.09 - 0.002, 1e-9);
  EXPECT_NEAR(release.heading_rad, -0.01, 1e-9);
  EXPECT_NEAR(release.spin_radps, -1.5, 1e-9);
  EXPECT_NEAR(release.hog_distance_m, near_hog_m - (release.stone_y_m - 0.6 * std::cos(0.01)), 1e-9);
  EXPECT_FALSE(delivery.truth().held);
}

TEST(World, a_robot_that_brakes_does_not_touch_the_stone_and_one_that_rolls_on_burns_it) {
  for (const bool brakes : {true, false}) {
    Delivery delivery(exact_scenario());
    delivery.speed_up_to(2.09, 0.4);
    delivery.inputs.stone_free_at = delivery.now;
    for (int i = 0; i < 600; ++i) {
      if (brakes) delivery.axis = std::max(delivery.axis - 1.0 * 0.005 / 0.1, 0.0);
      delivery.drive_at(delivery.axis, delivery.axis, 5ms);
    }
    EXPECT_EQ(delivery.truth().burned.has_value(), !brakes);
  }
}

TEST(World, a_robot_that_turns_away_burns_the_stone_with_its_fingers) {
  Delivery delivery(exact_scenario());
  delivery.speed_up_to(1.0, 0.4);
  delivery.inputs.stone_free_at = delivery.now;
  delivery.drive_at(8.0, 10.0, 400ms);
  EXPECT_TRUE(delivery.truth().burned);
}

TEST(World, the_same_seed_gives_the_same_run_and_another_seed_another) {
  auto scenario = exact_scenario();
  scenario.robot.yaw_disturbance_radps = 0.01;
  const auto run = [&](std::uint64_t seed) {
    scenario.seed = seed;
    Delivery delivery(scenario);
    delivery.speed_up_to(2.0, 0.4);
    delivery.inputs.stone_free_at = delivery.now + 3ms;
    delivery.drive_at(5.0, 5.0, 5s);
    return std::pair{delivery.truth().stone.x_m, delivery.truth().body.yaw_rad};
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

}  // namespace
}  // namespace hogline::hw::sim
