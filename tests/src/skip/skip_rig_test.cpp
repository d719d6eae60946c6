// The practice skip is complete and says what it means; a rig without what the skip needs is refused by name.
#include "src/config/skip_rig.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"

namespace hogline::config {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
const std::string practice{embedded_file("rigs/skip.yaml")};

std::string with(const std::string& from, const std::string& to) {
  std::string text = practice;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(SkipRig, practice_is_read_whole) {
  const SkipRig rig = parse_skip_rig(practice, "skip.yaml");
  EXPECT_NEAR(rig.skip.aiming.pan.max_rad, 170.0 * degree, 1e-12);
  EXPECT_NEAR(rig.skip.aiming.tilt.min_rad, -20.0 * degree, 1e-12);
  EXPECT_NEAR(rig.skip.aiming.limit_margin_rad, 0.3 * degree, 1e-12);
  EXPECT_DOUBLE_EQ(rig.skip.wait_at.y_m, 28.3);
  EXPECT_EQ(rig.skip.look_frames, 10);
  EXPECT_TRUE(rig.head.duties.sync) << "nobody else is on the bus";
}

TEST(SkipRig, a_camera_on_the_head_is_where_its_mount_says) {
  const SkipRig rig = parse_skip_rig(practice, "skip.yaml");
  const servo::HeadPose far = servo::camera_pose(rig.skip.aiming.head, {});
  EXPECT_NEAR(far.bPc.x(), 0.2, 1e-12);
  EXPECT_NEAR(far.bPc.z(), 2.1, 1e-12);
  EXPECT_NEAR(far.bRc(2, 2), -std::sin(14.0 * degree), 1e-12) << "it looks down by its pitch";
  const servo::HeadPose raised = servo::camera_pose(rig.skip.aiming.head, {.pan_rad = 0.0, .tilt_rad = -14.0 * degree});
  EXPECT_NEAR(raised.bRc(2, 2), 0.0, 1e-12);
}

struct Wrong {
  const char* what;
  const char* from;
  const char* to;
  const char* key;
};
class BadSkipRig : public testing::TestWithParam<Wrong> {};

TEST_P(BadSkipRig, is_refused_by_name) {
  try {
    parse_skip_rig(with(GetParam().from, GetParam().to), "mine.yaml");
    FAIL() << GetParam().what;
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.file, "mine.yaml");
    EXPECT_EQ(e.key, GetParam().key) << e.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, BadSkipRig,
    testing::Values(Wrong{"no_skip", "\nskip:", "\nships:", "ships"},
                    Wrong{"unknown_key", "drive_lag_s", "drive_lags", "skip.head.drive_lags"},
                    Wrong{"lag_too_long", "drive_lag_s: 0.022", "drive_lag_s: 2.2", "skip.head.drive_lag_s"},
                    Wrong{"waits_in_the_house", "wait_at: {x_m: 0.0, y_m: 28.3}", "wait_at: {x_m: 0.0, y_m: 2.0}",
                          "skip.wait_at.y_m"},
                    Wrong{"no_far_camera", "\n  far: ", "\n  low: ", "cameras.far"},
                    Wrong{"looks_to_the_side", "look: {pan_deg: 0.0", "look: {pan_deg: 9.0", "skip.look.pan_deg"}),
    [](const auto& c) { return std::string(c.param.what); });

}  // namespace
}  // namespace hogline::config
