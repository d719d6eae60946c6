// A scenario is read whole or refused, and the seed alone decides what varies.
#include "src/config/scenario.hpp"

#include <gtest/gtest.h>

#include <string>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"

namespace hogline::config {
namespace {

const std::string practice{embedded_file("scenarios/practice.yaml")};

TEST(Scenario, the_same_seed_gives_the_same_robot) {
  const auto a = parse_scenario(practice, "practice.yaml", 7);
  const auto b = parse_scenario(practice, "practice.yaml", 7);
  EXPECT_EQ(a.robot.start_yaw_rad, b.robot.start_yaw_rad);
  EXPECT_EQ(a.robot.left_radius_error, b.robot.left_radius_error);
  EXPECT_EQ(a.stone.friction_scale, b.stone.friction_scale);
}

TEST(Scenario, another_seed_gives_another_robot_within_the_stated_range) {
  const auto a = parse_scenario(practice, "practice.yaml", 7);
  const auto b = parse_scenario(practice, "practice.yaml", 8);
  EXPECT_NE(a.robot.start_x_m, b.robot.start_x_m);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto s = parse_scenario(practice, "practice.yaml", seed);
    EXPECT_LE(std::abs(s.robot.start_x_m), 0.10) << seed;
    EXPECT_LE(std::abs(s.robot.start_y_m + 3.3), 0.15) << seed;
  }
}

TEST(Scenario, angles_arrive_in_radians) {
  const auto s = parse_scenario(practice, "practice.yaml", 1);
  EXPECT_NEAR(s.robot.pitch_rad_per_mps2, 0.25 * M_PI / 180.0, 1e-12);
}

TEST(Scenario, an_unknown_key_is_refused_with_the_nearest_one) {
  std::string text = practice;
  text.replace(text.find("mass_kg"), 7, "mass_lb");
  try {
    parse_scenario(text, "my.yaml", 1);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.key, "robot.mass_lb");
    EXPECT_NE(std::string(e.what()).find("did you mean mass_kg?"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace hogline::config
