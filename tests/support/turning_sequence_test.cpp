#include "tests/support/turning_sequence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

namespace hogline::testing {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

TEST(TurningSequence, TurnsTenDegreesWithinTheBasesLimits) {
  const TurningSequence sequence(turning_move());
  const int last = sequence.size() - 1;
  double fastest = 0.0;
  double hardest = 0.0;
  for (int k = 1; k <= last; ++k) {
    const double rate = sequence.truth(k).yaw_rate_radps;
    fastest = std::max(fastest, std::abs(rate));
    hardest = std::max(hardest, std::abs(rate - sequence.truth(k - 1).yaw_rate_radps) * 60.0);
  }
  EXPECT_NEAR((sequence.truth(last).body.yaw_rad - sequence.truth(0).body.yaw_rad) / degree, 10.0, 0.02);
  EXPECT_NEAR(fastest / degree, 20.0, 0.5);
  EXPECT_LE(hardest / degree, 61.0);
  EXPECT_EQ(sequence.truth(0).yaw_rate_radps, 0.0);
  EXPECT_NEAR(sequence.truth(last).yaw_rate_radps / degree, 0.0, 0.05);
  EXPECT_GE(sequence.size(), 45);
  EXPECT_LE(sequence.size(), 75);
}

TEST(TurningSequence, TheGyroFollowsTheTruthAsWellAsTheDeviceDoes) {
  const TurningSequence sequence(turning_move());
  double gyro_rad = 0.0;
  double worst_rad = 0.0;
  for (int k = 0; k < sequence.size(); ++k) {
    gyro_rad += sequence.truth(k).gyro_yaw_increment_rad;
    const double turned = sequence.truth(k).body.yaw_rad - sequence.truth(0).body.yaw_rad;
    worst_rad = std::max(worst_rad, std::abs(gyro_rad - turned));
  }
  EXPECT_LT(worst_rad / degree, 0.03);
  EXPECT_GT(worst_rad / degree, 0.001) << "a gyro without errors is none";
}

TEST(TurningSequence, TheSameMoveGivesTheSameBytesInAnyOrder) {
  const TurningSequence first(turning_move_among_people(7));
  const TurningSequence second(turning_move_among_people(7), 2);
  const cv::Mat a = first.frame(30).bgr;
  second.frame(31);
  EXPECT_EQ(cv::norm(a, second.frame(30).bgr, cv::NORM_INF), 0.0);
  EXPECT_NE(cv::norm(a, TurningSequence(turning_move_among_people(8)).frame(30).bgr, cv::NORM_INF), 0.0);
}

TEST(TurningSequence, PeopleHideDifferentPartsAsTheyWalk) {
  TurningMove clean = turning_move();
  TurningMove crowded = turning_move_among_people();
  clean.sensor.noisy = crowded.sensor.noisy = false;
  const TurningSequence without(clean);
  const TurningSequence with(crowded);
  cv::Point where[2];
  for (int i = 0; i < 2; ++i) {
    const int k = i == 0 ? 2 : without.size() - 3;
    cv::Mat changed;
    cv::absdiff(without.frame(k).bgr, with.frame(k).bgr, changed);
    cv::extractChannel(changed, changed, 1);
    changed = changed > 20;
    EXPECT_GT(cv::countNonZero(changed), 20000) << "frame " << k;
    cv::minMaxLoc(changed, nullptr, nullptr, nullptr, &where[i]);
  }
  EXPECT_GT(cv::norm(where[0] - where[1]), 50.0);
}

TEST(TurningSequence, MotionBlursThePaint) {
  TurningMove sharp = turning_move();
  sharp.exposure_s = 0.0;
  const TurningMove blurred = turning_move();
  const auto edges = [](const TurningMove& move) {
    const TurningSequence sequence(move);
    const cv::Mat frame = sequence.frame(sequence.size() / 2).bgr;
    cv::Mat steps;
    cv::absdiff(frame.colRange(1, frame.cols), frame.colRange(0, frame.cols - 1), steps);
    return cv::countNonZero(steps.reshape(1) > 90);
  };
  EXPECT_LT(edges(blurred), 0.8 * edges(sharp));
}

}  // namespace
}  // namespace hogline::testing
