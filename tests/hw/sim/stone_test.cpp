// The stone: FCV1's checks, and its way from the jaws.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

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

TEST(StoneMotion, the_friction_coefficient_is_that_of_ice) {
  for (const double speed : {0.3, 1.0, 2.3}) {
    StoneTruth stone{.vy_mps = speed};
    slide(stone, exact_scenario().stone, dt_s);
    const double coefficient = (speed - stone.vy_mps) / dt_s / 9.80665;
    EXPECT_GE(coefficient, 0.006) << speed;
    EXPECT_LE(coefficient, 0.016) << speed;
  }
}

TEST(StoneMotion, the_curl_does_not_depend_on_how_fast_the_stone_turns) {
  EXPECT_NEAR(run_from_hog(2.09, 1.0, exact_scenario().stone).curl_m,
              run_from_hog(2.09, 2.5, exact_scenario().stone).curl_m, 0.01);
}

TEST(StoneMotion, the_lane_beside_the_centre_line_is_slower) {
  auto scenario = exact_scenario().stone;
  scenario.lane_friction = 0.05;
  StoneTruth middle{.x_m = 0.0, .vy_mps = 2.0};
  StoneTruth beside{.x_m = -2.0, .vy_mps = 2.0};
  slide(middle, scenario, dt_s);
  slide(beside, scenario, dt_s);
  EXPECT_NEAR((2.0 - beside.vy_mps) / (2.0 - middle.vy_mps), 1.1, 1e-9);
}

TEST(StoneMotion, a_floor_that_is_not_level_carries_the_stone_aside) {
  auto scenario = exact_scenario().stone;
  scenario.curl_gain = 0.0;
  scenario.lateral_acceleration_mps2 = 0.0005;
  const auto run = run_from_hog(2.09, 1.5, scenario);
  const double without_friction_m = 0.5 * 0.0005 * run.to_rest_s * run.to_rest_s;
  EXPECT_LT(-run.curl_m, without_friction_m);
  EXPECT_GT(-run.curl_m, 0.4 * without_friction_m) << "friction brakes this motion, too";
}

struct Momenta {
  double x = 0.0;
  double y = 0.0;
  double turning = 0.0;  // about e's origin, per mass
  double energy = 0.0;   // per mass
};
Momenta momenta(const std::vector<StoneTruth>& stones, double radius_m) {
  Momenta m;
  const double inertia = 0.5 * radius_m * radius_m;  // a disc's, per mass
  for (const auto& s : stones) {
    m.x += s.vx_mps;
    m.y += s.vy_mps;
    m.turning += s.x_m * s.vy_mps - s.y_m * s.vx_mps + inertia * s.spin_radps;
    m.energy += 0.5 * (s.vx_mps * s.vx_mps + s.vy_mps * s.vy_mps + inertia * s.spin_radps * s.spin_radps);
  }
  return m;
}

RC_GTEST_PROP(Collision, conserves_momentum_and_angular_momentum_and_makes_no_energy, ()) {
  const auto number = [](int low, int high) { return 0.01 * *rc::gen::inRange(low, high); };
  auto scenario = exact_scenario().stone;
  scenario.restitution = number(0, 101);
  scenario.stone_friction = number(0, 60);
  const double direction = number(0, 628);
  StoneTruth a{.x_m = number(-200, 200),
               .y_m = number(0, 3000),
               .vx_mps = number(-300, 300),
               .vy_mps = number(-300, 300),
               .spin_radps = number(-300, 300)};
  StoneTruth b{.x_m = a.x_m + 0.2899 * std::cos(direction),
               .y_m = a.y_m + 0.2899 * std::sin(direction),
               .vx_mps = number(-300, 300),
               .vy_mps = number(-300, 300),
               .spin_radps = number(-300, 300)};
  const Momenta before = momenta({a, b}, 0.145);
  const bool hit = collide(a, b, scenario);
  const Momenta after = momenta({a, b}, 0.145);
  RC_ASSERT(std::abs(after.x - before.x) < 1e-12);
  RC_ASSERT(std::abs(after.y - before.y) < 1e-12);
  RC_ASSERT(std::abs(after.turning - before.turning) < 1e-9);
  RC_ASSERT(after.energy <= before.energy + 1e-12);
  RC_ASSERT(!collide(a, b, scenario) || scenario.restitution == 0.0);
  RC_CLASSIFY(hit);
}

TEST(Collision, head_on_the_target_takes_the_share_of_the_reference) {
  auto scenario = exact_scenario().stone;
  scenario.restitution = 0.9;
  StoneTruth a{.vy_mps = 2.0};
  StoneTruth b{.y_m = 0.29};
  ASSERT_TRUE(collide(a, b, scenario));
  EXPECT_NEAR(b.vy_mps, 0.95 * 2.0, 1e-12);
  EXPECT_NEAR(a.vy_mps, 0.05 * 2.0, 1e-12);
  EXPECT_EQ(b.vx_mps, 0.0);
}

TEST(Collision, stones_apart_or_parting_are_left_alone) {
  const auto scenario = exact_scenario().stone;
  StoneTruth a{.vy_mps = 2.0};
  StoneTruth far{.y_m = 0.2901};
  EXPECT_FALSE(collide(a, far, scenario));
  StoneTruth ahead{.y_m = 0.29, .vy_mps = 2.5};
  EXPECT_FALSE(collide(a, ahead, scenario));
}

TEST(Collision, a_turning_stone_drives_the_other_aside_by_friction_alone) {
  auto scenario = exact_scenario().stone;
  scenario.restitution = 1.0;
  StoneTruth a{.vy_mps = 2.0, .spin_radps = 2.0};
  StoneTruth b{.y_m = 0.29};
  auto smooth = scenario;
  StoneTruth c = a;
  StoneTruth d = b;
  collide(c, d, smooth);
  EXPECT_EQ(d.vx_mps, 0.0);
  EXPECT_EQ(d.spin_radps, 0.0);
  scenario.stone_friction = 0.1;
  collide(a, b, scenario);
  EXPECT_LT(b.vx_mps, 0.0) << "a's front rim runs to the left";
  EXPECT_LT(b.spin_radps, 0.0) << "gear wheels turn against each other";
  EXPECT_LE(std::abs(b.vx_mps), 0.1 * b.vy_mps + 1e-12) << "Coulomb's limit";
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

TEST(World, a_thrown_stone_takes_out_one_that_lies_in_its_way) {
  auto scenario = exact_scenario();
  scenario.stone.restitution = 0.9;
  scenario.stone.curl_gain = 0.0;
  scenario.stone.others = {{0.0, 12.0}, {1.0, 12.0}};
  Delivery delivery(scenario);
  delivery.speed_up_to(2.5, 0.4);
  delivery.inputs.stone_free_at = delivery.now;
  delivery.drive_at(0.0, 0.0, 20s);
  const auto& truth = delivery.truth();
  EXPECT_EQ(truth.hits, 1);
  EXPECT_GT(truth.others[0].y_m, 20.0);
  EXPECT_LT(truth.stone.y_m, 13.0);
  EXPECT_EQ(truth.others[1].y_m, 12.0);
}

TEST(World, friction_differs_from_throw_to_throw_as_the_scenario_says) {
  auto scenario = exact_scenario();
  scenario.robot.start_y_m = 0.0;
  scenario.stone.throw_friction_sigma = 0.01;
  double sum = 0.0;
  double squares = 0.0;
  constexpr int throws = 200;
  for (int i = 0; i < throws; ++i) {
    scenario.seed = static_cast<std::uint64_t>(i);
    World world(scenario, Stamp{});
    world.step({.axes = {20.0, 20.0}, .stone_free_at = Stamp{} + 700ms}, Stamp{} + 700ms);
    const double before = world.truth().stone.vy_mps;
    world.step({.axes = {0.0, 0.0}, .stone_free_at = {}}, Stamp{} + 800ms);
    const double scale =
        (before - world.truth().stone.vy_mps) / (0.1 * 9.80665 * (0.00200985 / (before + 0.06385782) + 0.00626286));
    sum += scale - 1.0;
    squares += (scale - 1.0) * (scale - 1.0);
  }
  EXPECT_NEAR(sum / throws, 0.0, 0.003);
  EXPECT_NEAR(std::sqrt(squares / throws), 0.01, 0.0015);
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
