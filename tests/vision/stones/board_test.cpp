#include "vision/board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hogline::vision {
namespace {

using ::testing::Contains;
using ::testing::Not;

StoneSighting stone(double x_m, double y_m, Team team = Team::first, double sigma_m = 0.003) {
  StoneSighting s;
  s.x_m = x_m;
  s.y_m = y_m;
  s.team = team;
  s.covariance = {sigma_m * sigma_m, 0.0, sigma_m * sigma_m};
  return s;
}

struct Case {
  const char* what;
  double x_m, y_m;
  bool in_play, in_house, hogged, certain;
};

// A stone's radius is 0.145; the sheet is 4.75 wide.
const Case cases[] = {
    {"on the button", 0.0, 0.0, true, true, false, true},
    {"bites the outer ring from outside", 0.0, 1.95, true, true, false, true},
    {"a hair outside the house", 0.0, 1.99, true, false, false, true},
    {"too near to the ring to call", 0.0, 1.975, true, false, false, false},
    {"behind the tee, on the back line", 0.0, -1.9, true, true, false, true},
    {"wholly behind the back line", 0.0, -2.0, false, false, false, true},
    {"between the house and the hog line", 0.5, 4.0, true, false, false, true},
    {"touches the hog line", 0.5, 6.27, false, false, true, true},
    {"clears the hog line", 0.5, 6.24, true, false, false, true},
    {"touches the sideline", 2.25, 1.0, false, false, false, true},
    {"clears the sideline", -2.22, 1.0, true, false, false, true},
};

TEST(Board, EachStoneUnderTheRules) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const Board board = judge({stone(c.x_m, c.y_m)}, 4.75);
    ASSERT_EQ(board.stones.size(), 1U);
    const RuledStone& s = board.stones[0];
    EXPECT_EQ(s.in_play, c.in_play);
    EXPECT_EQ(s.in_house, c.in_house);
    EXPECT_EQ(s.hogged, c.hogged);
    EXPECT_EQ(s.certain, c.certain);
    EXPECT_EQ(board.shot.has_value(), c.in_house);
  }
}

TEST(Board, ASheetWithoutSidelinesHasNoneToTouch) {
  EXPECT_TRUE(judge({stone(2.4, 1.0)}, std::nullopt).stones[0].in_play);
}

TEST(Board, NamesTheLinesThatAStoneTouches) {
  const auto touches = [](double x_m, double y_m) { return judge({stone(x_m, y_m)}, 4.75).stones[0].touches; };
  EXPECT_THAT(touches(0.1, 0.1), Contains("centre_line"));
  EXPECT_THAT(touches(0.1, 0.1), Contains("tee_line"));
  EXPECT_THAT(touches(0.3, 0.2), Not(Contains("centre_line")));
  EXPECT_THAT(touches(1.0, -1.8), Contains("back_line"));
  EXPECT_THAT(touches(1.0, 6.3), Contains("hog_line"));
  EXPECT_THAT(touches(-2.3, 3.0), Contains("left_sideline"));
  EXPECT_THAT(touches(2.3, 3.0), Contains("right_sideline"));
  EXPECT_TRUE(touches(1.0, 3.0).empty());
}

TEST(Board, CountsTheStonesBetterThanTheOthersBest) {
  const Board board = judge({stone(0.0, 1.5, Team::first), stone(0.3, 0.0, Team::second), stone(0.0, 0.6, Team::second),
                             stone(0.0, -0.9, Team::first), stone(0.0, 4.0, Team::second)},
                            4.75);
  EXPECT_EQ(board.scoring, Team::second);
  EXPECT_EQ(board.score, 2);
  EXPECT_TRUE(board.shot_certain);
  EXPECT_EQ(board.stones[*board.shot].order, 1);
  EXPECT_NEAR(board.stones[*board.shot].tee_distance_m, 0.3, 1e-12);
  EXPECT_EQ(board.stones.back().order, 0) << "a guard does not count";
}

TEST(Board, TwoStonesTooNearToCallAreNotCalled) {
  EXPECT_FALSE(judge({stone(0.5, 0.0, Team::first, 0.01), stone(-0.51, 0.0, Team::second, 0.01)}, 4.75).shot_certain);
  EXPECT_TRUE(judge({stone(0.5, 0.0, Team::first, 0.001), stone(-0.51, 0.0, Team::second, 0.001)}, 4.75).shot_certain);
  EXPECT_TRUE(judge({stone(0.5, 0.0, Team::first, 0.01), stone(-0.51, 0.0, Team::first, 0.01)}, 4.75).shot_certain);
}

TEST(Board, AnUnknownTeamScoresNothing) {
  const Board board = judge({stone(0.1, 0.0, Team::unknown), stone(0.5, 0.0, Team::first)}, 4.75);
  EXPECT_EQ(board.scoring, Team::unknown);
  EXPECT_EQ(board.score, 0);
  EXPECT_FALSE(board.shot_certain);
}

TEST(Board, AnEmptySheetHasNoShotStone) {
  const Board board = judge({}, 4.75);
  EXPECT_FALSE(board.shot);
  EXPECT_EQ(board.score, 0);
}

}  // namespace
}  // namespace hogline::vision
