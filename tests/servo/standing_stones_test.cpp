// Stones that lie on the sheet, from many looks.
#include "servo/standing_stones.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hogline::servo {
namespace {

StoneSighting seen(double x_m, double y_m, Team team = Team::first, double sigma_m = 0.006) {
  StoneSighting s;
  s.x_m = x_m, s.y_m = y_m;
  s.covariance = {sigma_m * sigma_m, 0.0, sigma_m * sigma_m};
  s.team = team;
  return s;
}

StonesPercept look(std::vector<StoneSighting> stones) {
  StonesPercept percept;
  percept.ok = true;
  percept.stones = std::move(stones);
  return percept;
}

TEST(StandingStones, AreTheMeanOfTheirLooks) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.006);
  StandingStones stones;
  for (int i = 0; i < 100; ++i) {
    stones.add(
        look({seen(0.5 + noise(random), 2.0 + noise(random)), seen(-0.2 + noise(random), -1.0 + noise(random))}));
  }
  const auto found = stones.stones();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].y_m, -1.0, 0.003) << "nearest to the skip first";
  EXPECT_NEAR(found[1].x_m, 0.5, 0.003);
  EXPECT_GT(std::sqrt(found[1].covariance.xx_m2), 0.004) << "looks from one place share their errors";
}

TEST(StandingStones, LeaveOutWhatFewLooksShow) {
  StandingStones stones;
  for (int i = 0; i < 10; ++i) stones.add(look(i < 4 ? std::vector{seen(0, 0), seen(1, 1)} : std::vector{seen(0, 0)}));
  EXPECT_EQ(stones.stones().size(), 1U);
}

TEST(StandingStones, HaveTheTeamOfMostLooksThatCouldTell) {
  StandingStones stones;
  for (const Team team : {Team::unknown, Team::second, Team::unknown, Team::second, Team::first, Team::unknown}) {
    stones.add(look({seen(0, 0, team)}));
  }
  EXPECT_EQ(stones.stones().at(0).team, Team::second);
}

TEST(StandingStones, TakeNothingFromLooksThatAreNone) {
  StandingStones stones;
  StonesPercept blind;
  blind.stones = {seen(0, 0)};
  stones.add(blind);
  EXPECT_EQ(stones.looks(), 0);
  stones.add(look({seen(std::numeric_limits<double>::quiet_NaN(), 0), seen(0, 0, Team::first, 0.0)}));
  EXPECT_TRUE(stones.stones().empty());
}

}  // namespace
}  // namespace hogline::servo
