// Whole runs, rendered: the tracker follows them through motion blur and rocking, on unseen sheets.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/run_sequence.hpp"
#include "vision/low_sequence.hpp"

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
