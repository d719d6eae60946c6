#include "vision/low_sequence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/vision/low/painted_ice.hpp"

namespace hogline::vision {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::Not;

constexpr double rate_hz = 30.0;
constexpr double speed_mps = 2.6;

Stamp at(int frame) { return Stamp{from_seconds(frame / rate_hz)}; }

PaintedSheet run_frame(const CameraSetup&, int frame) {
  PaintedSheet sheet;
  sheet.body = {.x_m = 0.05, .y_m = rules::tee_to_hog_m - 1.35 + speed_mps * frame / rate_hz, .yaw_rad = -0.003};
  return sheet;
}

TEST(low_sequence, carries_the_distance_on_when_the_line_has_left_the_picture) {
  const CameraSetup setup = low_camera();
  LowSequence sequence(setup);
  int dead_reckoned = 0;
  double last_sigma_m = 0.0;
  for (int frame = 0; frame < 13; ++frame) {
    SCOPED_TRACE(frame);
    const PaintedSheet sheet = run_frame(setup, frame);
    const SheetPosePercept& seen = sequence.step(paint(setup, sheet), at(frame));
    ASSERT_TRUE(seen.ok) << seen.reason;
    EXPECT_EQ(seen.stamp, at(frame));
    EXPECT_NEAR(seen.hog_distance_m, rules::tee_to_hog_m - sheet.body.y_m, 0.005);
    if (seen.features.front() == "dead_reckoning") {
      ++dead_reckoned;
      EXPECT_GT(seen.hog_distance_sigma_m, last_sigma_m) << "what is not seen grows less sure";
      last_sigma_m = seen.hog_distance_sigma_m;
      EXPECT_THAT(seen.features, Contains("centre_line")) << "direction and offset are still measured";
      EXPECT_NEAR(seen.body.x_m, sheet.body.x_m, 0.002);
      EXPECT_NEAR(seen.body.yaw_rad, sheet.body.yaw_rad, 0.0005);
    } else {
      EXPECT_EQ(dead_reckoned, 0) << "seen again after it left the picture";
    }
  }
  EXPECT_GE(dead_reckoned, 3);
}

TEST(low_sequence, does_not_dead_reckon_a_line_that_should_be_in_view) {
  const CameraSetup setup = low_camera();
  LowSequence sequence(setup);
  for (int frame = 0; frame < 4; ++frame) {
    ASSERT_TRUE(sequence.step(paint(setup, run_frame(setup, frame)), at(frame)).ok);
  }
  const cv::Mat covered(setup.intrinsics.height_px, setup.intrinsics.width_px, CV_8UC3, cv::Scalar(0, 0, 0));
  const SheetPosePercept blind = sequence.step(covered, at(4));
  EXPECT_FALSE(blind.ok);
  EXPECT_FALSE(blind.reason.empty());
  EXPECT_TRUE(sequence.step(paint(setup, run_frame(setup, 5)), at(5)).ok) << "recovers";
}

TEST(low_sequence, dead_reckoning_ends) {
  const CameraSetup setup = low_camera();
  LowSequence sequence(setup);
  int frame = 4;
  for (; frame < 8; ++frame) ASSERT_TRUE(sequence.step(paint(setup, run_frame(setup, frame)), at(frame)).ok);
  const cv::Mat covered(setup.intrinsics.height_px, setup.intrinsics.width_px, CV_8UC3, cv::Scalar(0, 0, 0));
  const int end = frame + static_cast<int>(LowSequence::longest_blind_s * rate_hz) + 2;
  SheetPosePercept last;
  for (; frame < end; ++frame) last = sequence.step(covered, at(frame));
  EXPECT_FALSE(last.ok);
}

TEST(low_sequence, refuses_frames_that_are_not_newer) {
  const CameraSetup setup = low_camera();
  LowSequence sequence(setup);
  const cv::Mat image = paint(setup, run_frame(setup, 0));
  ASSERT_TRUE(sequence.step(image, at(1)).ok);
  EXPECT_FALSE(sequence.step(image, at(1)).ok);
  EXPECT_FALSE(sequence.step(image, at(0)).ok);
  EXPECT_TRUE(sequence.step(paint(setup, run_frame(setup, 1)), at(2)).ok);
}

TEST(low_sequence, predicts_the_next_frame) {
  const CameraSetup setup = low_camera();
  LowSequence sequence(setup);
  EXPECT_FALSE(sequence.predict(at(0)).body.has_value());
  for (int frame = 0; frame < 4; ++frame) sequence.step(paint(setup, run_frame(setup, frame)), at(frame));
  const LowViewPrediction next = sequence.predict(at(4));
  ASSERT_TRUE(next.body.has_value());
  EXPECT_NEAR(next.body->y_m, run_frame(setup, 4).body.y_m, 0.01);
  EXPECT_GT(next.body_sigma.y_m, 0.0);
}

}  // namespace
}  // namespace hogline::vision
