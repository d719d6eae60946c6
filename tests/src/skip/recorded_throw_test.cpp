// A throw that is seen in rendered pictures and recorded, and the recording followed again: whole, damaged, cut off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "hw/files/image_file.hpp"
#include "src/skip/skip_vision.hpp"
#include "src/skip/track_recording.hpp"
#include "tests/src/skip/practice.hpp"

namespace hogline::test {
namespace {

namespace fs = std::filesystem;

using servo::StoneOutcome;
using servo::ThrowResult;

/// One throw, followed live and recorded, for all tests of this file.
class RecordedThrow : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ =
        testing::TempDir() + "/hogline_recorded_" + std::to_string(testing::UnitTest::GetInstance()->random_seed());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    request_ = new SkipRequest(practice_throw(ThrowKind::hit, 3));
    set_rates(request_->scenario, 5.0, 5.0);
    request_->eyes = SkipEyes::vision;
    request_->record = folder_;
    live_ = new SkipOutcome(follow_throw(*request_));
  }
  static void TearDownTestSuite() {
    fs::remove_all(folder_);
    delete live_;
    delete request_;
  }

  /// A copy of the recording that may be damaged.
  static std::string copy(const std::string& name) {
    const std::string to = folder_ + "/" + name;
    fs::create_directories(to);
    for (const auto& file : fs::directory_iterator(folder_)) {
      if (file.is_regular_file()) fs::create_hard_link(file.path(), fs::path(to) / file.path().filename());
    }
    return to;
  }

  static TrackedThrow tracked(const std::string& folder) {
    SkipVision seer(request_->rig);
    const auto& k = request_->rig.rig.camera("near").intrinsics;
    const auto load = [size = cv::Size(k.width_px, k.height_px)](const hw::files::RecordedFrame& f) {
      hw::Frame frame;
      frame.bgr = hw::files::load_image(f.path, size).bgr;
      return frame;
    };
    return track_recording(read_skip_recording(folder), request_->rig.skip, request_->ice, seer, load);
  }

  static inline std::string folder_;
  static inline SkipRequest* request_ = nullptr;
  static inline SkipOutcome* live_ = nullptr;
};

void expect_the_same(const ThrowResult& a, const ThrowResult& b, double place_m) {
  ASSERT_EQ(a.stones.size(), b.stones.size());
  for (std::size_t i = 0; i < a.stones.size(); ++i) {
    const StoneOutcome &s = a.stones[i], &t = b.stones[i];
    EXPECT_EQ(s.fate, t.fate) << "stone " << i;
    EXPECT_EQ(s.thrown, t.thrown);
    EXPECT_EQ(s.moved, t.moved) << "stone " << i;
    EXPECT_EQ(s.team, t.team);
    if (s.fate != servo::StoneFate::at_rest) continue;
    EXPECT_NEAR(s.x_m, t.x_m, place_m) << "stone " << i;
    EXPECT_NEAR(s.y_m, t.y_m, place_m) << "stone " << i;
  }
  ASSERT_EQ(a.collisions.size(), b.collisions.size());
  for (std::size_t i = 0; i < a.collisions.size(); ++i) {
    EXPECT_EQ(a.collisions[i].striker, b.collisions[i].striker);
    EXPECT_EQ(a.collisions[i].struck, b.collisions[i].struck);
  }
  ASSERT_TRUE(a.hog_to_hog_s && b.hog_to_hog_s);
  EXPECT_NEAR(a.hog_to_hog_s->value, b.hog_to_hog_s->value, 0.02);
}

TEST_F(RecordedThrow, GivesWhatWasSeenLive) {
  ASSERT_TRUE(live_->report.ok) << live_->report.reason;
  ASSERT_EQ(live_->report.result.collisions.size(), 1U);
  const TrackedThrow again = tracked(folder_);
  EXPECT_TRUE(again.report.ok) << again.report.reason;
  EXPECT_EQ(again.near_frames, live_->near_frames);
  EXPECT_EQ(again.far_frames, live_->far_frames);
  EXPECT_EQ(again.unread, 0);
  expect_the_same(live_->report.result, again.report.result, 0.004);
  // Times count from the release, which was recorded.
  const auto after_s = [](const ThrowResult& r, Stamp origin) { return seconds(r.collisions.at(0).stamp - origin); };
  EXPECT_NEAR(after_s(again.report.result, again.origin), after_s(live_->report.result, *live_->released), 0.02);
}

// The handle is seen by both views, at five pictures a second.
TEST_F(RecordedThrow, TellsHowTheStoneTurned) {
  const auto& rotation = live_->report.result.rotation;
  ASSERT_TRUE(rotation.ok) << rotation.reason;
  const double truth = request_->scene.thrown.motion.spin_radps;
  EXPECT_NEAR(rotation.spin_radps, truth, std::max(0.05, 4.0 * rotation.sigma_radps));
  EXPECT_LT(rotation.sigma_radps, 0.1);
}

TEST_F(RecordedThrow, IsFollowedThoughSomePicturesAreSpoiled) {
  const std::string folder = copy("spoiled");
  const SkipRecording whole = read_skip_recording(folder);
  const std::size_t near = whole.near.frames.size() - 12, far = whole.far.frames.size() / 2;
  fs::remove(whole.near.frames[near].path);
  fs::remove(whole.far.frames[far].path);
  fs::copy_file(whole.far.frames[far + 2].path, folder + "/cut.jpg");
  fs::remove(whole.far.frames[far + 2].path);
  fs::rename(folder + "/cut.jpg", whole.far.frames[far + 2].path);
  fs::resize_file(whole.far.frames[far + 2].path, 20000);
  const TrackedThrow again = tracked(folder);
  EXPECT_EQ(again.unread, 3);
  EXPECT_TRUE(again.report.ok) << again.report.reason;
  expect_the_same(live_->report.result, again.report.result, 0.006);
}

TEST_F(RecordedThrow, WithoutTheReleaseItIsFollowedFromSight) {
  const std::string folder = copy("unannounced");
  fs::remove(folder + "/release.csv");
  const TrackedThrow again = tracked(folder);
  EXPECT_TRUE(again.report.ok) << again.report.reason;
  expect_the_same(live_->report.result, again.report.result, 0.006);
}

TEST_F(RecordedThrow, CutOffItSaysThatItEndedEarly) {
  const std::string folder = copy("cut_off");
  for (const char* name : {"/near.csv", "/far.csv"}) {
    std::ifstream in(folder_ + name);
    std::string text, line;
    for (int i = 0; std::getline(in, line) && i < 60; ++i) text += line + "\n";
    fs::remove(folder + name);
    std::ofstream(folder + name) << text;
  }
  const TrackedThrow again = tracked(folder);
  EXPECT_FALSE(again.report.ok);
  EXPECT_EQ(again.report.reason, "it ended before all lay still");
}

}  // namespace
}  // namespace hogline::test
