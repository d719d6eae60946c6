#include "vision/stone_average.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hogline::vision {
namespace {

StonesPercept frame(std::vector<StoneSighting> stones) {
  StonesPercept p;
  p.ok = true;
  p.stones = std::move(stones);
  return p;
}

StoneSighting stone(double x_m, double y_m, Team team = Team::first) {
  StoneSighting s;
  s.x_m = x_m;
  s.y_m = y_m;
  s.team = team;
  s.covariance = {1e-4, 0.0, 4e-4};
  return s;
}

// A wobble without randomness: every value as often above as below.
double wobble(int k) { return 0.004 * std::sin(2.4 * k + 0.3); }

TEST(StoneAverage, ThirtyFramesAreBetterThanOne) {
  StoneAverage average;
  for (int k = 0; k < 30; ++k) average.add(frame({stone(1.0 + wobble(k), 2.0 + wobble(k + 7))}));
  const auto stones = average.stones();
  ASSERT_EQ(stones.size(), 1U);
  EXPECT_NEAR(stones[0].x_m, 1.0, 0.0005);
  EXPECT_NEAR(stones[0].y_m, 2.0, 0.0005);
  EXPECT_LT(stones[0].covariance.xx_m2, 0.6e-4);
}

TEST(StoneAverage, OutliersDoNotCount) {
  StoneAverage average;
  for (int k = 0; k < 30; ++k) average.add(frame({stone(1.0 + wobble(k) + (k % 6 == 5 ? 0.1 : 0.0), 2.0)}));
  ASSERT_EQ(average.stones().size(), 1U);
  EXPECT_NEAR(average.stones()[0].x_m, 1.0, 0.001);
}

TEST(StoneAverage, WhatIsSeenOnceIsNoStone) {
  StoneAverage average;
  for (int k = 0; k < 10; ++k) {
    std::vector<StoneSighting> stones{stone(1.0, 2.0)};
    if (k == 4) stones.push_back(stone(-1.0, 3.0));
    average.add(frame(stones));
  }
  EXPECT_EQ(average.stones().size(), 1U);
}

TEST(StoneAverage, TheTeamIsTheMajoritysAndUnknownWithoutOne) {
  StoneAverage sure;
  StoneAverage unsure;
  for (int k = 0; k < 10; ++k) {
    sure.add(frame({stone(1.0, 2.0, k < 3 ? Team::unknown : Team::second)}));
    unsure.add(frame({stone(1.0, 2.0, k < 5 ? Team::first : Team::second)}));
  }
  EXPECT_EQ(sure.stones()[0].team, Team::second);
  EXPECT_EQ(unsure.stones()[0].team, Team::unknown);
}

TEST(StoneAverage, TouchingStonesStayTwo) {
  StoneAverage average;
  for (int k = 0; k < 5; ++k) average.add(frame({stone(1.0, 2.0), stone(1.29, 2.0)}));
  EXPECT_EQ(average.stones().size(), 2U);
}

TEST(StoneAverage, AFrameInWhichNothingCouldBeSaidCountsForNothing) {
  StoneAverage average;
  average.add(frame({stone(1.0, 2.0)}));
  for (int k = 0; k < 5; ++k) average.add({});
  EXPECT_EQ(average.frames(), 1);
  EXPECT_EQ(average.stones().size(), 1U);
}

}  // namespace
}  // namespace hogline::vision
