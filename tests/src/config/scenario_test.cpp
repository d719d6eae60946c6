// A scenario is read whole or refused, and the seed alone decides what varies.
#include "src/config/scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
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
  EXPECT_NEAR(s.robot.pitch_rad_per_mps2, 0.25 * std::numbers::pi / 180.0, 1e-12);
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

std::string practice_with(const std::string& more) { return practice.substr(0, practice.find("ranges:")) + more; }

struct Wrong {
  const char* description;
  const char* ranges;
  const char* key;
  const char* says;
};

TEST(ScenarioRanges, what_can_not_be_drawn_is_refused_with_its_key) {
  for (const Wrong& w :
       {Wrong{"unknown section", "ranges: {roboter: {mass_kg: [1, 2]}}", "ranges.roboter", "no such section"},
        Wrong{"unknown key", "ranges: {robot: {mass_lb: [1, 2]}}", "ranges.robot.mass_lb", "no such key"},
        Wrong{"not a pair", "ranges: {robot: {mass_kg: [100]}}", "ranges.robot.mass_kg", "[lowest, highest]"},
        Wrong{"wrong way round", "ranges: {robot: {mass_kg: [120, 80]}}", "ranges.robot.mass_kg", "own value, 100"},
        Wrong{"nominal outside", "ranges: {robot: {mass_kg: [101, 120]}}", "ranges.robot.mass_kg", "own value, 100"},
        Wrong{"beyond the schema", "ranges: {robot: {mass_kg: [90, 900]}}", "ranges.robot.mass_kg", "10 to 500"},
        Wrong{"range of whole numbers", "ranges: {people: {count: [0, 4]}}", "ranges.people.count", "whole number"},
        Wrong{"range of a word", "ranges: {sheet: {sideline: [line, rope]}}", "ranges.sheet.sideline", "choices"},
        Wrong{"wrong choice", "choices: {sheet: {sideline: [line, wall]}}", "choices.sheet.sideline", "bumper"},
        Wrong{"empty choice", "choices: {sheet: {sideline: []}}", "choices.sheet.sideline", "list"},
        Wrong{"range and choice", "ranges: {robot: {mass_kg: [90, 120]}}\nchoices: {robot: {mass_kg: [90]}}",
              "choices.robot.mass_kg", "a range already"}}) {
    try {
      ScenarioFile(practice_with(w.ranges), "my.yaml");
      ADD_FAILURE() << w.description;
    } catch (const ConfigError& e) {
      EXPECT_EQ(e.key, w.key) << w.description;
      EXPECT_NE(std::string(e.what()).find(w.says), std::string::npos) << e.what();
    }
  }
}

TEST(ScenarioRanges, draws_fill_the_range_and_choices_all_come) {
  const ScenarioFile file(practice_with("ranges: {robot: {mass_kg: [80, 120]}}\n"
                                        "choices: {sheet: {sideline: [line, rope, none]}}"),
                          "my.yaml");
  double lowest = 1e9;
  double highest = 0.0;
  std::array<int, 4> kinds{};
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto s = file.draw(seed);
    lowest = std::min(lowest, s.robot.mass_kg);
    highest = std::max(highest, s.robot.mass_kg);
    ++kinds[static_cast<std::size_t>(s.sheet.sideline)];
  }
  EXPECT_GE(lowest, 80.0);
  EXPECT_LT(lowest, 81.0);
  EXPECT_LE(highest, 120.0);
  EXPECT_GT(highest, 119.0);
  EXPECT_EQ(kinds[static_cast<std::size_t>(hw::sim::SidelineKind::bumper)], 0);
  for (const auto kind : {hw::sim::SidelineKind::line, hw::sim::SidelineKind::rope, hw::sim::SidelineKind::none}) {
    EXPECT_GT(kinds[static_cast<std::size_t>(kind)], 60);
  }
}

TEST(Scenario, every_one_that_comes_with_the_program_is_read) {
  int scenarios = 0;
  for (const EmbeddedFile& file : embedded_files()) {
    if (!file.name.starts_with("scenarios/")) continue;
    ++scenarios;
    const ScenarioFile scenario(file.content, std::string(file.name));
    for (std::uint64_t seed = 0; seed < 50; ++seed) EXPECT_GT(scenario.draw(seed).robot.mass_kg, 0.0);
  }
  EXPECT_GE(scenarios, 2);
}

TEST(ScenarioRanges, another_range_changes_no_other_draw) {
  const std::string one = "ranges: {robot: {mass_kg: [80, 120]}}";
  const std::string two = "ranges: {robot: {mass_kg: [80, 120], start_x_m: [-0.5, 0.5]}}";
  EXPECT_EQ(parse_scenario(practice_with(one), "a", 9).robot.mass_kg,
            parse_scenario(practice_with(two), "b", 9).robot.mass_kg);
}

TEST(ScenarioRanges, without_them_every_seed_gives_the_nominal_rink) {
  EXPECT_EQ(parse_scenario(practice_with(""), "a", 1).robot.start_x_m, 0.0);
  EXPECT_EQ(parse_scenario(practice_with(""), "a", 2).robot.start_x_m, 0.0);
}

}  // namespace
}  // namespace hogline::config
