// A recorded throw: what is written comes back, a throw is followed from it, a folder that is none is refused by name.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "servo/ice_model.hpp"
#include "servo/skip_sheet.hpp"
#include "servo/stone_path.hpp"
#include "src/config/config_error.hpp"
#include "src/skip/skip_set.hpp"
#include "src/skip/track_recording.hpp"

namespace hogline::test {
namespace {

namespace fs = std::filesystem;

/// A folder with these files, gone at the end.
class Folder {
 public:
  Folder()
      : path_(testing::TempDir() + "/hogline_track_" +
              std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + std::to_string(count_++)) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ + "/" + name) << text; }
  const std::string& path() const { return path_; }

 private:
  static inline int count_ = 0;
  std::string path_;
};

constexpr const char* stamps_head = "name,id,time_s\n";
constexpr const char* angles_head = "time_s,pan_deg,tilt_deg\n";

/// Sees a stone that was let go half a second after the recording began, as the far view would.
class FarOnly final : public SkipSeer {
 public:
  FarOnly(const servo::StonePath& path, Stamp released) : path_(path), released_(released) {}
  servo::NearSight near_view(const hw::Frame&, const servo::HeadAngles&, const servo::SkipDiagnosis&) override {
    return {};
  }
  FarPercept far_view(const hw::Frame& frame, const servo::HeadAngles&, const servo::SkipDiagnosis&) override {
    FarPercept percept;
    percept.ok = true;
    percept.stamp = frame.stamp;
    const double after_s = seconds(frame.stamp - released_);
    if (after_s < 0.0) return percept;
    const servo::SlidingStone at = path_.at(after_s).stone;
    StoneSighting seen;
    seen.x_m = at.x_m + 0.005 * normal_(random_), seen.y_m = at.y_m + 0.02 * normal_(random_);
    seen.covariance = {2.5e-5, 0.0, 4e-4};
    seen.team = Team::first;
    percept.stones = {seen};
    return percept;
  }

 private:
  const servo::StonePath& path_;
  Stamp released_;
  std::mt19937_64 random_{5};
  std::normal_distribution<double> normal_;
};

TEST(Track, follows_a_throw_that_only_the_far_camera_recorded) {
  const Folder folder;
  std::string frames = stamps_head;
  for (int i = 0; i < 340; ++i)
    frames += "f" + std::to_string(i) + ".jpg," + std::to_string(i) + "," + std::to_string(7.0 + 0.05 * i) + "\n";
  folder.write("far.csv", frames);
  folder.write("head.csv", std::string(angles_head) + "7.0,0,-10\n25.0,1,-8\n");

  const servo::StonePath path({0.1, 29.2, -0.03, -2.1, 1.5}, {});
  FarOnly seer(path, Stamp{std::chrono::milliseconds(1500)});
  servo::SkipConfig config = load_skip_rig_or_practice("").skip;
  config.known_body = PlanarPose{0.1, -4.1, 0.0};
  config.expected_spin_radps = 1.5;
  const TrackedThrow tracked =
      track_recording(read_skip_recording(folder.path()), config, servo::IceModel(servo::IceModelConfig{}).estimate(),
                      seer, [](const auto&) { return hw::Frame{}; });
  EXPECT_EQ(tracked.far_frames, 340);
  EXPECT_FALSE(tracked.report.ok) << "it ended while the stone ran";
  EXPECT_EQ(tracked.report.reason, "it ended before all lay still");
  ASSERT_TRUE(tracked.report.result.ok);
  const auto& result = tracked.report.result;
  ASSERT_TRUE(result.hog_to_hog_s);
  const double truth_s = *path.crossing_s(servo::hog_line_m) - *path.crossing_s(servo::far_hog_line_m);
  EXPECT_NEAR(result.hog_to_hog_s->value, truth_s, 0.05);
  ASSERT_EQ(result.stones.size(), 1U);
  EXPECT_EQ(result.stones[0].fate, servo::StoneFate::lost) << "where it came to rest nobody saw";
}

struct Wrong {
  const char* name;
  const char* far;
  const char* head;
  const char* file;  ///< that the message names
};
class BadRecording : public testing::TestWithParam<Wrong> {};

TEST_P(BadRecording, is_refused_by_name) {
  const Folder folder;
  if (GetParam().far) folder.write("far.csv", GetParam().far);
  if (GetParam().head) folder.write("head.csv", GetParam().head);
  try {
    read_skip_recording(folder.path());
    FAIL();
  } catch (const config::ConfigError& e) {
    EXPECT_NE(e.file.find(GetParam().file), std::string::npos) << e.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, BadRecording,
    testing::Values(
        Wrong{"no_camera", nullptr, "time_s,pan_deg,tilt_deg\n0,0,0\n", "hogline_track_"},
        Wrong{"no_head", "name,id,time_s\na.jpg,0,0.0\n", nullptr, "head.csv"},
        Wrong{"no_angles", "name,id,time_s\na.jpg,0,0.0\n", "time_s,pan_deg,tilt_deg\n", "head.csv"},
        Wrong{"no_number", "name,id,time_s\na.jpg,0,0.0\n", "time_s,pan_deg,tilt_deg\n0,left,0\n", "head.csv"},
        Wrong{"a_column_too_many", "name,id,time_s\na.jpg,0,0.0\n", "time_s,pan_deg,tilt_deg\n0,0,0,0\n", "head.csv"},
        Wrong{"time_goes_back", "name,id,time_s\na.jpg,0,0.0\n", "time_s,pan_deg,tilt_deg\n1,0,0\n0,0,0\n", "head.csv"},
        Wrong{"stamps_go_back", "name,id,time_s\na.jpg,0,1.0\nb.jpg,1,0.5\n", "time_s,pan_deg,tilt_deg\n0,0,0\n",
              "far.csv"}),
    [](const auto& c) { return std::string(c.param.name); });

TEST(Recording, gives_angles_between_its_rows_and_none_far_from_them) {
  const Folder folder;
  folder.write("far.csv", std::string(stamps_head) + "a.jpg,0,0.0\n");
  folder.write("head.csv", std::string(angles_head) + "1.0,10,0\n2.0,20,-4\n");
  const SkipRecording recording = read_skip_recording(folder.path());
  constexpr double degree = std::numbers::pi / 180.0;
  EXPECT_NEAR(angles_at(recording, std::chrono::milliseconds(1500))->pan_rad, 15.0 * degree, 1e-12);
  EXPECT_NEAR(angles_at(recording, std::chrono::milliseconds(1250))->tilt_rad, -1.0 * degree, 1e-12);
  EXPECT_FALSE(angles_at(recording, std::chrono::milliseconds(2100)));
  EXPECT_FALSE(angles_at(recording, std::chrono::milliseconds(900)));
}

}  // namespace
}  // namespace hogline::test
