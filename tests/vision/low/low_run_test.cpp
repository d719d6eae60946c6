// Whole runs, rendered: the tracker follows them through motion blur and rocking, on unseen sheets.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/run_sequence.hpp"
#include "vision/low_sequence.hpp"
#include "vision/low_view.hpp"

namespace hogline::vision {
namespace {

using hogline::testing::random_run;
using hogline::testing::RunFrame;
using hogline::testing::RunSequence;

constexpr double degree = std::numbers::pi / 180.0;

struct Sums {
  int frames = 0;
  double square = 0.0;
  void add(double error) { ++frames, square += error * error; }
  double rms() const { return std::sqrt(square / std::max(frames, 1)); }
};

class AnyRun : public ::testing::TestWithParam<int> {};

TEST_P(AnyRun, IsFollowedToItsEnd) {
  const RunSequence run(random_run(static_cast<std::uint64_t>(GetParam())));
  LowSequence low(run.setup());
  Sums all;
  Sums last;
  Sums yaw;
  Sums across;
  int acquired = 0;
  int blind = 0;
  for (int k = 0; k < run.size(); ++k) {
    SCOPED_TRACE(k);
    const RunFrame frame = run.frame(k);
    const SheetPosePercept& seen = low.step(frame.bgr, frame.stamp);
    ASSERT_TRUE(seen.ok) << seen.reason << "; " << low.diagnosis().lost;
    acquired += seen.features.front() == "acquired" ? 1 : 0;
    blind += low.diagnosis().blind ? 1 : 0;
    const double error_m = seen.hog_distance_m - frame.hog_distance_m;
    EXPECT_LT(std::abs(error_m), 5.0 * seen.hog_distance_sigma_m + 0.001);
    all.add(error_m);
    if (k >= run.size() - 12) last.add(error_m);
    yaw.add(seen.body.yaw_rad - frame.body.yaw_rad);
    across.add(seen.body.x_m - frame.body.x_m);
  }
  EXPECT_LT(all.rms(), 0.030) << "far off, without sidelines or a ring, the lean is hardly seen";
  EXPECT_LT(last.rms(), 0.006);
  EXPECT_LT(yaw.rms(), 0.1 * degree);
  EXPECT_LT(across.rms(), 0.005);
  EXPECT_LE(acquired, 2);
  EXPECT_GE(blind, 3) << "the line has left the picture before the run ends";
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyRun, ::testing::Values(1, 6, 11, 16));

/// Each frame alone and in the sequence, against the truth.
struct Compared {
  Sums tracked;
  Sums alone;
  Sums tracked_in_sigmas;
  int lost = 0;
  int acquired = 0;
};

Compared compare(const hogline::testing::RunMove& move, int stride) {
  const RunSequence run(move);
  LowSequence low(run.setup());
  LowView view(run.setup());
  Compared compared;
  for (int k = 0; k < run.size(); ++k) {
    const RunFrame frame = run.frame(k);
    const SheetPosePercept& seen = low.step(frame.bgr, frame.stamp);
    compared.lost += seen.ok ? 0 : 1;
    compared.acquired += seen.ok && seen.features.front() == "acquired" ? 1 : 0;
    if (!seen.ok || k % stride != 0) continue;
    const double error_m = seen.hog_distance_m - frame.hog_distance_m;
    compared.tracked.add(error_m);
    compared.tracked_in_sigmas.add(error_m / seen.hog_distance_sigma_m);
    if (low.diagnosis().blind) continue;
    const SheetPosePercept alone = view.acquire(frame.bgr, frame.stamp);
    if (alone.ok) compared.alone.add(alone.hog_distance_m - frame.hog_distance_m);
  }
  return compared;
}

struct StillCase {
  const char* description;
  double hog_distance_m;
  double speed_mps;
  double yaw_rate_radps;
};

// A robot that hardly moves sees the same picture again: what the first one told must not be forgotten.
TEST(LowRun, ARobotThatStandsCreepsOrTurnsIsMeasuredAsWellAsByFramesAlone) {
  for (const StillCase& c : {StillCase{"stands far off", 4.2, 0.0, 0.0}, StillCase{"stands near by", 1.4, 0.0, 0.0},
                             StillCase{"creeps", 2.6, 0.04, 0.0}, StillCase{"turns", 2.2, 0.0, 0.15}}) {
    for (const std::uint64_t seed : {3}) {
      SCOPED_TRACE(std::string(c.description) + ", " + std::to_string(seed));
      hogline::testing::RunMove move = hogline::testing::random_run(seed);
      move.first_hog_distance_m = c.hog_distance_m;
      move.speed_mps = c.speed_mps;
      move.yaw_rate_radps = c.yaw_rate_radps;
      move.legs = {{0.2, 0.0}};
      const Compared compared = compare(move, 5);
      EXPECT_EQ(compared.lost, 0);
      EXPECT_EQ(compared.acquired, 1) << "one acquisition, the rest is tracked";
      EXPECT_LT(compared.tracked.rms(), 1.3 * compared.alone.rms() + 0.004);
      EXPECT_LT(compared.tracked_in_sigmas.rms(), 2.5);
    }
  }
}

TEST(LowRun, IsFollowedFromStandstillToFullSpeedAndThroughBraking) {
  for (const std::uint64_t seed : {10}) {
    SCOPED_TRACE(seed);
    hogline::testing::RunMove move = hogline::testing::random_run(seed);
    move.speed_mps = 0.0;
    move.first_hog_distance_m = 4.6;
    move.legs = {{0.1, 0.0}, {1.5, 0.9}, {0.9, -1.5}, {0.1, 0.0}};
    const Compared compared = compare(move, 12);
    EXPECT_EQ(compared.lost, 0);
    EXPECT_LE(compared.acquired, 3);
    EXPECT_LT(compared.tracked.rms(), 1.3 * compared.alone.rms() + 0.004);
    EXPECT_LT(compared.tracked_in_sigmas.rms(), 2.0);

    move.speed_mps = 3.5;
    move.first_hog_distance_m = 5.0;
    move.legs = {{0.2, 0.0}, {1.0, -2.5}, {0.1, 0.0}};
    const Compared braking = compare(move, 12);
    EXPECT_EQ(braking.lost, 0);
    EXPECT_LE(braking.acquired, 3);
    EXPECT_LT(braking.tracked_in_sigmas.rms(), 2.0);
  }
}

TEST(LowRun, IsTakenUpAgainAfterFramesThatShowNothing) {
  const RunSequence run(random_run(2));
  LowSequence low(run.setup());
  const cv::Mat covered(run.setup().intrinsics.height_px, run.setup().intrinsics.width_px, CV_8UC3,
                        cv::Scalar(2, 2, 2));
  for (int k = 0; k < 24; ++k) {
    SCOPED_TRACE(k);
    const RunFrame frame = run.frame(k);
    const bool hidden = k >= 8 && k < 11;
    const SheetPosePercept& seen = low.step(hidden ? covered : frame.bgr, frame.stamp);
    EXPECT_EQ(seen.ok, !hidden) << seen.reason;
    if (k == 11) {
      EXPECT_EQ(seen.features.front(), "acquired");
    }
    if (k > 11) {
      EXPECT_TRUE(low.diagnosis().tracked) << low.diagnosis().lost;
    }
    if (seen.ok) {
      EXPECT_LT(std::abs(seen.hog_distance_m - frame.hog_distance_m), 4.0 * seen.hog_distance_sigma_m + 0.001);
    }
  }
}

}  // namespace
}  // namespace hogline::vision
