// The near view over consecutive frames: tracks, knows when it is lost, and finds back.
#include "vision/near_sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tests/support/turning_sequence.hpp"

namespace hogline::vision {
namespace {

using hogline::testing::turning_move;
using hogline::testing::turning_move_among_people;
using hogline::testing::TurningFrame;
using hogline::testing::TurningMove;
using hogline::testing::TurningSequence;

constexpr double degree = std::numbers::pi / 180.0;

Stamp at_frame(int k) { return Stamp{from_seconds(k / 60.0)}; }

struct Statistics {
  int tracked = 0;
  int acquired = 0;
  int lost = 0;
  double yaw_square = 0.0;
  double worst_yaw_rad = 0.0;
  double worst_place_m = 0.0;
  double normalised_square = 0.0;

  int seen() const { return tracked + acquired; }
  double yaw_rms_deg() const { return std::sqrt(yaw_square / seen()) / degree; }
  double normalised() const { return std::sqrt(normalised_square / seen()); }

  void add(const SheetPosePercept& p, const PlanarPose& truth, bool was_tracked) {
    if (!p.ok) {
      ++lost;
      return;
    }
    (was_tracked ? tracked : acquired) += 1;
    const double off = p.body.yaw_rad - truth.yaw_rad;
    yaw_square += off * off;
    normalised_square += off * off / (p.sigma.yaw_rad * p.sigma.yaw_rad);
    worst_yaw_rad = std::max(worst_yaw_rad, std::abs(off));
    worst_place_m = std::max(worst_place_m, std::hypot(p.body.x_m - truth.x_m, p.body.y_m - truth.y_m));
  }
};

enum class Gyro { none, used };

Statistics run(const TurningMove& move, Gyro gyro, int every = 1) {
  const TurningSequence sequence(move);
  NearSequence near(sequence.setup());
  Statistics statistics;
  double turned_rad = 0.0;
  for (int k = 0; k < sequence.size(); ++k) {
    turned_rad += sequence.truth(k).gyro_yaw_increment_rad;
    if (k % every != 0) continue;
    const TurningFrame frame = sequence.frame(k);
    const auto increment = gyro == Gyro::used ? std::optional(turned_rad) : std::nullopt;
    const SheetPosePercept& p = near.step(frame.bgr, frame.stamp, increment);
    turned_rad = 0.0;
    statistics.add(p, frame.body, near.diagnosis().tracked);
    EXPECT_TRUE(k == 0 || near.diagnosis().tracked) << "frame " << k << ": " << near.diagnosis().lost << p.reason;
  }
  return statistics;
}

struct Turn {
  const char* what;
  bool people;
  bool clockwise;
  Gyro gyro;
  int every;
};

class TurningRobot : public ::testing::TestWithParam<Turn> {};

TEST_P(TurningRobot, IsTrackedFromTheFirstFrameToTheLast) {
  const Turn& turn = GetParam();
  TurningMove move = turn.people ? turning_move_among_people(11) : turning_move(12);
  if (turn.clockwise) {
    move.turn_rad = -move.turn_rad;
    move.start_yaw_rad = -move.start_yaw_rad;
  }
  const Statistics s = run(move, turn.gyro, turn.every);
  EXPECT_EQ(s.lost, 0);
  EXPECT_EQ(s.acquired, 1) << "the first frame only";
  EXPECT_LT(s.yaw_rms_deg(), 0.003);
  EXPECT_LT(s.worst_yaw_rad / degree, 0.008);
  EXPECT_LT(s.worst_place_m, 0.002);
  EXPECT_LT(s.normalised(), 1.5) << "says how wrong it is";
  RecordProperty("yaw_rms_mdeg", std::to_string(1000.0 * s.yaw_rms_deg()));
}

INSTANTIATE_TEST_SUITE_P(Moves, TurningRobot,
                         ::testing::Values(Turn{"alone_by_its_own_motion", false, false, Gyro::none, 1},
                                           Turn{"clockwise_with_the_gyro", false, true, Gyro::used, 2},
                                           Turn{"among_people_by_its_own_motion", true, false, Gyro::none, 1},
                                           Turn{"among_people_with_the_gyro", true, true, Gyro::used, 2},
                                           Turn{"every_fourth_frame_with_the_gyro", false, false, Gyro::used, 4}),
                         [](const auto& row) { return std::string(row.param.what); });

/// Frames of a robot that turns slowly, to be spoilt.
class SpoiltFrames : public ::testing::Test {
 protected:
  SpoiltFrames() : near_(sequence_.setup()) {}

  void SetUp() override {
    for (int k = 0; k < 4; ++k) step(frame_.bgr);
    ASSERT_TRUE(near_.diagnosis().tracked) << near_.diagnosis().lost;
  }
  const SheetPosePercept& step(const cv::Mat& image, std::optional<double> turned = 0.0) {
    return near_.step(image, at_frame(next_++), turned);
  }
  cv::Mat like(double value) const { return {frame_.bgr.size(), CV_8UC3, cv::Scalar::all(value)}; }

  TurningSequence sequence_{turning_move(5)};
  TurningFrame frame_ = sequence_.frame(0);
  NearSequence near_;
  int next_ = 0;
};

TEST_F(SpoiltFrames, ThatShowNothingAreRefusedAndTheNextGoodOneIsSeenAgain) {
  cv::Mat noise(frame_.bgr.size(), CV_8UC3);
  cv::RNG(7).fill(noise, cv::RNG::UNIFORM, 0, 256);
  for (const cv::Mat& image : {like(0.0), like(255.0), noise, cv::Mat()}) {
    const SheetPosePercept& nothing = step(image);
    EXPECT_FALSE(nothing.ok);
    EXPECT_FALSE(nothing.reason.empty());
    EXPECT_FALSE(near_.diagnosis().lost.empty());
    const SheetPosePercept& again = step(frame_.bgr);
    ASSERT_TRUE(again.ok) << again.reason;
    EXPECT_NEAR(again.body.yaw_rad, frame_.body.yaw_rad, 0.005 * degree);
  }
}

TEST_F(SpoiltFrames, OneInBetweenDoesNotCostAnAcquisition) {
  step(like(0.0));
  step(frame_.bgr);
  EXPECT_TRUE(near_.diagnosis().tracked) << near_.diagnosis().lost;
}

struct Jump {
  const char* what;
  double yaw_deg;
  double x_m;
  double y_m;
};

class JumpedView : public ::testing::TestWithParam<Jump> {};

// As after a picture that was shown late, or of a robot that was carried elsewhere.
TEST_P(JumpedView, IsLostAndAcquiredInTheSameFrame) {
  const TurningSequence sequence(turning_move(6));
  TurningMove there = turning_move(6);
  there.start_yaw_rad += GetParam().yaw_deg * degree;
  there.start_x_m += GetParam().x_m;
  there.start_y_m += GetParam().y_m;
  const TurningFrame before = sequence.frame(0);
  const TurningFrame after = TurningSequence(there).frame(0);

  NearSequence near(sequence.setup());
  for (int k = 0; k < 4; ++k) near.step(before.bgr, at_frame(k), 0.0);
  ASSERT_TRUE(near.diagnosis().tracked);
  const SheetPosePercept found = near.step(after.bgr, at_frame(4), 0.0);
  EXPECT_FALSE(near.diagnosis().tracked);
  EXPECT_FALSE(near.diagnosis().lost.empty());
  ASSERT_TRUE(found.ok) << found.reason;
  EXPECT_EQ(found.features.front(), "acquired");
  EXPECT_NEAR(found.body.yaw_rad, after.body.yaw_rad, 0.01 * degree);
  EXPECT_NEAR(found.body.x_m, after.body.x_m, 0.003);

  near.step(after.bgr, at_frame(5), 0.0);
  EXPECT_TRUE(near.diagnosis().tracked) << near.diagnosis().lost;
}

INSTANTIATE_TEST_SUITE_P(Jumps, JumpedView,
                         ::testing::Values(Jump{"three_degrees", 3.0, 0.0, 0.0},
                                           Jump{"minus_three_degrees", -3.0, 0.0, 0.0},
                                           Jump{"eight_degrees", 8.0, 0.0, 0.0}, Jump{"aside", 0.0, 0.6, 0.0},
                                           Jump{"ahead", 0.0, 0.0, 1.0}),
                         [](const auto& row) { return std::string(row.param.what); });

TEST(NearSequence, AcquiresOnceAndTracksTheSamePictureToTheSamePlace) {
  const TurningSequence sequence(turning_move(3));
  const cv::Mat image = sequence.frame(30).bgr;
  NearSequence near(sequence.setup());
  const SheetPosePercept acquired = near.step(image, at_frame(0));
  ASSERT_TRUE(acquired.ok) << acquired.reason;
  EXPECT_EQ(acquired.features.front(), "acquired");
  EXPECT_EQ(near.diagnosis().lost, "no frame before shows the sheet");
  for (int k = 1; k < 20; ++k) {
    const SheetPosePercept& p = near.step(image, at_frame(k));
    ASSERT_TRUE(p.ok && near.diagnosis().tracked) << near.diagnosis().lost;
    EXPECT_EQ(p.features.front(), "tracked");
    EXPECT_EQ(near.diagnosis().frames_tracked, k);
    EXPECT_NEAR(p.body.yaw_rad, acquired.body.yaw_rad, 0.004 * degree);
    EXPECT_NEAR(p.body.x_m, acquired.body.x_m, 0.001);
    EXPECT_NEAR(p.body.y_m, acquired.body.y_m, 0.001);
    ASSERT_TRUE(p.sheet_width_m && acquired.sheet_width_m);
    EXPECT_NEAR(*p.sheet_width_m, *acquired.sheet_width_m, 0.006);
  }
}

TEST(NearSequence, RefusesStampsThatDoNotGrowAndGoesOnUnharmed) {
  const TurningSequence sequence(turning_move(3));
  const cv::Mat image = sequence.frame(30).bgr;
  NearSequence near(sequence.setup());
  for (int k = 0; k < 4; ++k) near.step(image, at_frame(k), 0.0);
  for (const int stale : {3, 2, 0}) {
    const SheetPosePercept& p = near.step(image, at_frame(stale), 0.0);
    EXPECT_FALSE(p.ok);
    EXPECT_EQ(p.reason, "the frame is not newer than the one before");
  }
  EXPECT_TRUE(near.step(image, at_frame(4), 0.0).ok);
  EXPECT_TRUE(near.diagnosis().tracked) << near.diagnosis().lost;
}

TEST(NearSequence, AcquiresAfterAGap) {
  const TurningSequence sequence(turning_move(3));
  const cv::Mat image = sequence.frame(30).bgr;
  NearSequence near(sequence.setup());
  for (int k = 0; k < 3; ++k) near.step(image, at_frame(k));
  EXPECT_TRUE(near.step(image, at_frame(2) + from_seconds(NearSequence::longest_gap_s + 0.01)).ok);
  EXPECT_EQ(near.diagnosis().lost, "the frames before are too old");
  EXPECT_FALSE(near.diagnosis().tracked);
}

// A gyro that says anything else than a number, or that the robot spins, must not lead the tracker astray.
TEST(NearSequence, SurvivesAGyroThatLies) {
  const TurningSequence sequence(turning_move(3));
  const TurningFrame frame = sequence.frame(30);
  NearSequence near(sequence.setup());
  int k = 0;
  for (; k < 4; ++k) near.step(frame.bgr, at_frame(k), 0.0);
  for (const double lie :
       {0.05, -1.0, 1e6, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const SheetPosePercept& p = near.step(frame.bgr, at_frame(k++), lie);
    ASSERT_TRUE(p.ok) << lie << ": " << p.reason;
    EXPECT_NEAR(p.body.yaw_rad, frame.body.yaw_rad, 0.005 * degree) << lie;
  }
}

// Told nothing by a gyro, and turning the other way from one frame to the next: at 20 degrees a second and back.
TEST(NearSequence, FollowsAJerkWithoutAnAcquisition) {
  const TurningSequence sequence(turning_move(8));
  NearSequence near(sequence.setup());
  int stamp = 0;
  for (const int k : {30, 31, 32, 33, 34, 33, 32, 31, 32, 33}) {
    const TurningFrame frame = sequence.frame(k);
    const SheetPosePercept& p = near.step(frame.bgr, at_frame(stamp++));
    ASSERT_TRUE(p.ok) << p.reason;
    EXPECT_TRUE(stamp == 1 || near.diagnosis().tracked) << "frame " << stamp << ": " << near.diagnosis().lost;
    EXPECT_NEAR(p.body.yaw_rad, frame.body.yaw_rad, 0.005 * degree);
  }
}

TEST(NearSequence, GivesTheSameAnswersAgain) {
  const TurningSequence sequence(turning_move_among_people(4));
  std::vector<double> first;
  for (int pass = 0; pass < 2; ++pass) {
    NearSequence near(sequence.setup());
    for (int k = 20; k < 26; ++k) {
      const TurningFrame frame = sequence.frame(k);
      const SheetPosePercept& p = near.step(frame.bgr, frame.stamp);
      if (pass == 0) {
        first.push_back(p.body.yaw_rad);
      } else {
        EXPECT_EQ(p.body.yaw_rad, first[static_cast<std::size_t>(k - 20)]);
      }
    }
  }
}

}  // namespace
}  // namespace hogline::vision
