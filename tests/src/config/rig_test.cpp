// A rig file is read whole or refused with one line that names file, key, value and what is allowed.
#include "src/config/rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "src/config/config_error.hpp"

namespace hogline::config {
namespace {

const std::string good = R"(cameras:
  near:
    width_px: 1600
    height_px: 1200
    model: brown_conrady
    fx_px: 780.0
    fy_px: 781.0
    cx_px: 803.2
    cy_px: 596.4
    distortion: [-0.12, 0.015, 3.0e-4, -2e-04, 0]
    gamma: 2.2
    mount: {x_m: 0.2, y_m: 0.0, z_m: 2.0, roll_deg: 0.5, pitch_deg: 28.0, yaw_deg: -1.0}
sheet: {width_m: 4.75, sideline: bumper}
ice: {paint_depth_m: 0.006, refractive_index: 1.309}
stone: {handle_radius_m: 0.095, handle_height_m: 0.125}
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = good;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Rig, is_read_in_SI_units_and_radians) {
  const Rig rig = parse_rig(good, "rig.yaml");
  const auto& near = rig.camera("near");
  EXPECT_EQ(near.intrinsics.width_px, 1600);
  EXPECT_DOUBLE_EQ(near.intrinsics.fy_px, 781.0);
  EXPECT_DOUBLE_EQ(near.intrinsics.distortion[2], 3e-4);
  EXPECT_DOUBLE_EQ(near.gamma, 2.2);
  EXPECT_NEAR(near.mount.pitch_rad, 28.0 * std::numbers::pi / 180.0, 1e-15);
  EXPECT_EQ(near.sheet.sideline, vision::SidelineKind::bumper);
  EXPECT_DOUBLE_EQ(near.ice.paint_depth_m, 0.006);
  EXPECT_DOUBLE_EQ(rig.stone.radius_m, 0.095);
}

TEST(Rig, knows_the_teams_by_name_and_hue) {
  const Rig usual = parse_rig(good, "rig.yaml");
  EXPECT_EQ(usual.stone.teams[0].name, "red");
  EXPECT_EQ(usual.stone.teams[1].name, "yellow");
  EXPECT_EQ(usual.stone.rim_rounding_m, 0.0);
  const std::string key = "handle_height_m: 0.125, handle_rim_rounding_m: 0.003, ";
  const auto teams = [&key](const std::string& list) {
    return parse_rig(with("handle_height_m: 0.125", key + "teams: " + list), "rig.yaml").stone;
  };
  const StoneHandle stone = teams("[{name: blue, hue_deg: 230}, {name: green, hue_deg: 120}]");
  EXPECT_EQ(stone.teams[0].name, "blue");
  EXPECT_NEAR(stone.teams[1].hue_rad, 2.0 * std::numbers::pi / 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(stone.rim_rounding_m, 0.003);
  for (const char* wrong : {"[{name: blue, hue_deg: 230}]", "[{name: blue, hue_deg: 230}, {name: blue, hue_deg: 0}]",
                            "[{name: blue, hue_deg: 350}, {name: red, hue_deg: 5}]",
                            "[{name: unknown, hue_deg: 230}, {name: red, hue_deg: 5}]",
                            "[{name: blue, hue_deg: 400}, {name: red, hue_deg: 5}]",
                            "[{name: '', hue_deg: 230}, {name: red, hue_deg: 5}]"}) {
    EXPECT_THROW(teams(wrong), ConfigError) << wrong;
  }
}

TEST(Rig, takes_the_paint_depth_as_given_unless_it_says_how_sure_it_is) {
  EXPECT_EQ(parse_rig(good, "rig.yaml").camera("near").paint_depth_sigma_m, 0.0);
  const Rig rig = parse_rig(with("refractive_index", "paint_depth_sigma_m: 0.003, refractive_index"), "rig.yaml");
  EXPECT_DOUBLE_EQ(rig.camera("near").paint_depth_sigma_m, 0.003);
}

TEST(Rig, names_the_camera_that_a_command_needs_and_the_rig_lacks) {
  const Rig rig = parse_rig(good, "rig.yaml");
  EXPECT_THROW(
      {
        try {
          rig.camera("low");
        } catch (const ConfigError& e) {
          EXPECT_EQ(e.key, "cameras.low");
          throw;
        }
      },
      ConfigError);
}

struct Refusal {
  std::string description;
  std::string text;
  std::string key;
  std::string says;  // words that the message must hold
};

std::ostream& operator<<(std::ostream& out, const Refusal& r) { return out << r.description; }

class RigRefusals : public testing::TestWithParam<Refusal> {};

TEST_P(RigRefusals, name_file_key_value_and_what_is_allowed) {
  const Refusal& refusal = GetParam();
  try {
    parse_rig(refusal.text, "rig.yaml");
    FAIL() << "accepted: " << refusal.description;
  } catch (const ConfigError& e) {
    const std::string message = e.what();
    EXPECT_EQ(e.key, refusal.key) << message;
    EXPECT_TRUE(message.starts_with("rig.yaml")) << message;
    EXPECT_NE(message.find(refusal.says), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, RigRefusals,
    testing::Values(
        Refusal{"zero focal length", with("fx_px: 780.0", "fx_px: 0"), "cameras.near.fx_px",
                "= 0: must be a number above 0"},
        Refusal{"negative focal length", with("fx_px: 780.0", "fx_px: -780"), "cameras.near.fx_px", "above 0"},
        Refusal{"not a number", with("fx_px: 780.0", "fx_px: .nan"), "cameras.near.fx_px", "finite"},
        Refusal{"infinity", with("cy_px: 596.4", "cy_px: -.inf"), "cameras.near.cy_px", "finite"},
        Refusal{"too large for a double", with("cy_px: 596.4", "cy_px: 1e999"), "cameras.near.cy_px", "finite"},
        Refusal{"NaN in a list", with("0.015", ".NaN"), "cameras.near.distortion[1]", "finite"},
        Refusal{"a word for a number", with("fx_px: 780.0", "fx_px: wide"), "cameras.near.fx_px",
                "= wide: must be a number"},
        Refusal{"a number in quotes", with("fx_px: 780.0", "fx_px: \"780\""), "cameras.near.fx_px", "must be a number"},
        Refusal{"a fraction for a count", with("width_px: 1600", "width_px: 1600.5"), "cameras.near.width_px",
                "whole number"},
        Refusal{"wrong unit", with("fx_px: 780.0", "fx_mm: 4.0"), "cameras.near.fx_mm", "did you mean fx_px?"},
        Refusal{"wrong unit of an angle", with("pitch_deg", "pitch_rad"), "cameras.near.mount.pitch_rad",
                "did you mean pitch_deg?"},
        Refusal{"unknown section", good + "colour: {red: 1}\n", "colour", "allowed here: ages, arm"},
        Refusal{"missing key", with("    gamma: 2.2\n", ""), "cameras.near.gamma",
                "missing; must be a number from 0.2 to 5.0"},
        Refusal{"missing section", with("ice: {paint_depth_m: 0.006, refractive_index: 1.309}\n", ""), "ice",
                "missing"},
        Refusal{"empty section", with("ice: {paint_depth_m: 0.006, refractive_index: 1.309}", "ice:"), "ice",
                "must be keys and values"},
        Refusal{"no camera", with("near:", "front:"), "cameras.front", "allowed here: far, low, near"},
        Refusal{"unknown model", with("brown_conrady", "fisheye"), "cameras.near.model",
                "one of brown_conrady, kannala_brandt"},
        Refusal{"too few coefficients", with("[-0.12, 0.015, 3.0e-4, -2e-04, 0]", "[-0.12, 0.015]"),
                "cameras.near.distortion", "4 to 5"},
        Refusal{"a coefficient short", with("[-0.12, 0.015, 3.0e-4, -2e-04, 0]", "[-0.12, 0.015, 0, 0]"),
                "cameras.near.distortion", "list of 5 values"},
        Refusal{"paint above the ice", with("paint_depth_m: 0.006", "paint_depth_m: -0.006"), "ice.paint_depth_m",
                "from 0.0 to 0.05"},
        Refusal{"negative sigma of the depth",
                with("refractive_index", "paint_depth_sigma_m: -0.001, refractive_index"), "ice.paint_depth_sigma_m",
                "from 0.0 to 0.01"},
        Refusal{"millimetres for metres", with("paint_depth_m: 0.006", "paint_depth_m: 6"), "ice.paint_depth_m",
                "from 0.0 to 0.05"},
        Refusal{"a key twice", with("    gamma: 2.2\n", "    gamma: 2.2\n    gamma: 1.0\n"), "cameras.near.gamma",
                "twice"},
        Refusal{"aliases that explode",
                "a0: &a0 [1,1,1,1,1,1,1,1,1,1]\na1: &a1 [*a0,*a0,*a0,*a0,*a0,*a0,*a0,*a0,*a0,*a0]\n"
                "a2: &a2 [*a1,*a1,*a1,*a1,*a1,*a1,*a1,*a1,*a1,*a1]\na3: &a3 [*a2,*a2,*a2,*a2,*a2,*a2,*a2,*a2,*a2,*a2]\n"
                "a4: &a4 [*a3,*a3,*a3,*a3,*a3,*a3,*a3,*a3,*a3,*a3]\na5: [*a4,*a4,*a4,*a4,*a4,*a4,*a4,*a4,*a4,*a4]\n",
                "", "too many values"},
        Refusal{"no YAML", "cameras: [", "", "not YAML"}, Refusal{"empty file", "", "", "must hold one YAML document"},
        Refusal{"broken, with documents without end", ", 1e999 : \n---\vb", "", ""},
        Refusal{"a list", "- 1\n- 2\n", "", "must hold one YAML document"},
        Refusal{"binary", std::string("\x89PNG\r\n\x1a\n\0\0", 10), "", ""}));

TEST(Rig, a_missing_file_is_named) {
  try {
    load_rig("/nowhere/rig.yaml");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(), "/nowhere/rig.yaml: no such file");
  }
}

TEST(Rig, says_on_which_line) {
  try {
    parse_rig(with("fx_px: 780.0", "fx_px: 0"), "rig.yaml");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.line, 6);
  }
}

}  // namespace
}  // namespace hogline::config
