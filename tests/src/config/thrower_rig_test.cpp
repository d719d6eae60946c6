// The practice rig is complete and says what it means; a rig that could break the rules is refused.
#include "src/config/thrower_rig.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"

namespace hogline::config {
namespace {

const std::string practice{embedded_file("rigs/practice.yaml")};

std::string with(const std::string& from, const std::string& to) {
  std::string text = practice;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ThrowerRig, practice_is_read_whole) {
  const ThrowerRig rig = parse_thrower_rig(practice, "practice.yaml");
  EXPECT_DOUBLE_EQ(rig.thrower.release.hog_distance_m, 0.5);
  EXPECT_EQ(rig.drive.left.direction, 1);
  EXPECT_EQ(rig.drive.right.direction, -1);
  EXPECT_EQ(rig.drive.left.vendor_id, 0x2f1U);
  EXPECT_EQ(rig.gripper.belt.unit, 10);
  EXPECT_NEAR(rig.thrower.limits.max_yaw_rate_radps, 20.0 * std::numbers::pi / 180.0, 1e-12);
}

TEST(ThrowerRig, the_cameras_rotation_follows_its_mount) {
  const ThrowerRig rig = parse_thrower_rig(practice, "practice.yaml");
  // The body's forward axis lies above the optical axis of a camera that looks down: image y is negative.
  EXPECT_NEAR(rig.thrower.alignment.near_cRb[3], -std::sin(28.0 * std::numbers::pi / 180.0), 1e-12);
  EXPECT_NEAR(rig.thrower.alignment.near_cRb[6], std::cos(28.0 * std::numbers::pi / 180.0), 1e-12);
}

TEST(ThrowerRig, a_rig_for_pictures_alone_is_refused_with_the_section_it_lacks) {
  std::string text = practice.substr(0, practice.find("\nbase:"));
  try {
    parse_thrower_rig(text, "rig.yaml");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.key, "base");
  }
}

TEST(ThrowerRig, a_cameras_silence_must_be_longer_than_a_look) {
  try {
    parse_thrower_rig(with("near_s: 0.050", "near_s: 0.2"), "rig.yaml");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.key, "cameras.near.source.silence_limit_s");
    EXPECT_NE(e.allowed.find("0.2"), std::string::npos) << e.allowed;
  }
}

TEST(ThrowerRig, a_release_that_could_break_the_hog_line_rule_is_refused) {
  try {
    parse_thrower_rig(with("tolerance_m: 0.08", "tolerance_m: 0.12"), "rig.yaml");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.key, "release");
  }
}

TEST(ThrowerRig, two_lines_to_the_gripper_are_refused) {
  EXPECT_THROW(parse_thrower_rig(with("  tcp: {address: 127.0.0.1, port: 502}\n", ""), "rig.yaml"), ConfigError);
}

TEST(ThrowerRig, two_wheels_on_one_node_are_refused) {
  EXPECT_THROW(parse_thrower_rig(with("node: 2", "node: 1"), "rig.yaml"), ConfigError);
}

}  // namespace
}  // namespace hogline::config
