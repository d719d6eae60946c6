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

TEST(ThrowerRig, the_head_is_on_the_wheels_bus) {
  const ThrowerRig rig = parse_thrower_rig(practice, "practice.yaml");
  ASSERT_TRUE(rig.head);
  EXPECT_EQ(rig.head->pan.identity.node, 3);
  EXPECT_EQ(rig.head->tilt.gearing.direction, -1);
  EXPECT_NEAR(rig.head->tilt.max_rad, 75.0 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_EQ(rig.head->master_node, rig.drive.master_node);
  EXPECT_EQ(rig.head->timing.rpdo_timeout, rig.drive.timing.rpdo_timeout);
  EXPECT_FALSE(rig.head->duties.sync) << "the wheels' adapter sends it";
  EXPECT_FALSE(rig.head->duties.heartbeat);
}

TEST(ThrowerRig, a_head_with_a_wheels_node_or_without_room_is_refused) {
  for (const auto& [from, to] : {std::pair{"    node: 3\n", "    node: 2\n"},
                                 {"    node: 4\n", "    node: 3\n"},
                                 {"min_deg: -20.0", "min_deg: 20.0"},
                                 {"tolerance_deg: 0.02", "tolerance_deg: 0.00001"}}) {
    try {
      parse_thrower_rig(with(from, to), "rig.yaml");
      FAIL() << to;
    } catch (const ConfigError& e) {
      EXPECT_EQ(e.key.substr(0, 4), "head") << to;
    }
  }
}

TEST(ThrowerRig, no_line_to_the_gripper_is_refused) {
  EXPECT_THROW(parse_thrower_rig(with("  tcp: {address: 127.0.0.1, port: 502}\n", ""), "rig.yaml"), ConfigError);
}

const std::string tcp_line = "  tcp: {address: 127.0.0.1, port: 502}\n";
const std::string rtu_line = "  rtu: {device: /dev/ttyUSB0, baud: 19200, parity: E, data_bits: 8, stop_bits: 1}\n";

TEST(ThrowerRig, a_serial_line_to_the_gripper_is_read) {
  const ThrowerRig rig = parse_thrower_rig(with(tcp_line, rtu_line), "rig.yaml");
  const auto& line = std::get<hw::ModbusRtu>(rig.modbus.line.line);
  EXPECT_EQ(line.device, "/dev/ttyUSB0");
  EXPECT_EQ(line.baud, 19200);
  EXPECT_EQ(line.parity, 'E');
  EXPECT_EQ(line.data_bits, 8);
  EXPECT_EQ(line.stop_bits, 1);
}

TEST(ThrowerRig, a_baud_rate_that_no_driver_knows_is_refused) {
  std::string odd = rtu_line;
  odd.replace(odd.find("19200"), 5, "19000");
  EXPECT_THROW(parse_thrower_rig(with(tcp_line, odd), "rig.yaml"), ConfigError);
}

TEST(ThrowerRig, both_lines_to_the_gripper_are_refused) {
  EXPECT_THROW(parse_thrower_rig(with(tcp_line, tcp_line + rtu_line), "rig.yaml"), ConfigError);
}

TEST(ThrowerRig, two_wheels_on_one_node_are_refused) {
  EXPECT_THROW(parse_thrower_rig(with("node: 2", "node: 1"), "rig.yaml"), ConfigError);
}

}  // namespace
}  // namespace hogline::config
