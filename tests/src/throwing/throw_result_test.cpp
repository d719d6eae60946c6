// The JSON that programs read: its keys and what is null when.
#include "src/throwing/throw_result.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace hogline {
namespace {

TEST(ThrowResult, a_released_stone_has_numbers_and_no_abort) {
  ThrowResult r;
  r.ok = true;
  r.release = ReleaseOutcome{.hog_distance_m = 0.51, .target_hog_distance_m = 0.50};
  r.states = {{"unfold", 0.0}, {"measure", 1.5}};
  const auto line = nlohmann::json::parse(result_line(r));
  EXPECT_TRUE(line.at("ok"));
  EXPECT_NEAR(line.at("release").at("error_mm").get<double>(), 10.0, 1e-9);
  for (const char* key : {"hog_distance_m", "target_hog_distance_m", "speed_error_mps", "heading_error_deg",
                          "lateral_error_mm", "spin_error_radps"}) {
    EXPECT_TRUE(line.at("release").at(key).is_number()) << key;
  }
  EXPECT_TRUE(line.at("abort").is_null());
  EXPECT_EQ(line.at("states").at(1).at("name"), "measure");
  EXPECT_FALSE(line.at("hog_line_violation"));
  for (const char* key : {"sim_time_s", "wall_time_s"}) EXPECT_TRUE(line.at(key).is_number()) << key;
}

TEST(ThrowResult, a_kept_stone_has_no_release_and_a_reason) {
  ThrowResult r;
  r.abort = "the gripper \"fell\" silent\n";
  const std::string text = result_line(r);
  const auto line = nlohmann::json::parse(text);
  EXPECT_TRUE(line.at("release").is_null());
  EXPECT_TRUE(line.at("yaw_after_alignment_deg").is_null());
  EXPECT_EQ(line.at("abort"), *r.abort);
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace hogline
