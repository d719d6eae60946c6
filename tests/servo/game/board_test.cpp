#include "servo/game/board.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace hogline::servo::test {
namespace {

constexpr double tee_m = 38.405;

struct Named {
  const char* what;
  double x_m;
  double y_m;
  bool house;
  bool guard;
  bool over_hog;
  bool through;
  bool side;  ///< of a sheet of 4.75 m
};

class Places : public testing::TestWithParam<Named> {};

TEST_P(Places, AreWhatTheRulesCallThem) {
  const Named& place = GetParam();
  const BoardStone stone{place.x_m, place.y_m};
  EXPECT_EQ(in_house(stone), place.house);
  EXPECT_EQ(in_free_guard_zone(stone), place.guard);
  EXPECT_EQ(past_hog_line(stone), place.over_hog);
  EXPECT_EQ(past_back_line(stone), place.through);
  EXPECT_EQ(touches_sideline(stone, 4.75), place.side);
}

INSTANTIATE_TEST_SUITE_P(
    Each, Places,
    testing::Values(Named{"on_the_button", 0.0, tee_m, true, false, true, false, false},
                    Named{"biting_the_house_in_front", 0.0, tee_m - 1.973, true, false, true, false, false},
                    Named{"just_in_front_of_the_house", 0.0, tee_m - 1.975, false, true, true, false, false},
                    Named{"on_the_hog_line", 0.0, 32.1, false, true, false, false, false},
                    Named{"just_over_the_hog_line", 0.0, 32.15, false, true, true, false, false},
                    Named{"beside_the_house_before_the_tee_line", 2.1, 38.2, false, true, true, false, false},
                    Named{"beside_the_house_on_the_tee_line", 2.1, 38.3, false, false, true, false, false},
                    Named{"on_the_back_line", 0.0, 40.3, true, false, true, false, false},
                    Named{"biting_the_back_line", 0.0, 40.378, true, false, true, false, false},
                    Named{"through", 0.0, 40.38, false, false, true, true, false},
                    Named{"at_the_sideline", 2.231, 35.0, false, true, true, false, true},
                    Named{"near_the_sideline", -2.229, 35.0, false, true, true, false, false}),
    [](const auto& place) { return std::string(place.param.what); });

struct Lying {
  Team team;
  double radius_m;  ///< from the tee
};

Board board_of(const std::vector<Lying>& stones) {
  Board board;
  std::array<std::size_t, 2> next{};
  for (const Lying& stone : stones) {
    const std::size_t side = side_of(stone.team);
    board.stones[side][next[side]++] = BoardStone{stone.radius_m, tee_m};
  }
  return board;
}

struct Scored {
  const char* what;
  std::vector<Lying> stones;
  EndScore score;
};

class Scores : public testing::TestWithParam<Scored> {};

TEST_P(Scores, AreAsTheRulesCountThem) { EXPECT_EQ(score(board_of(GetParam().stones)), GetParam().score); }

constexpr Team a = Team::first, b = Team::second;

INSTANTIATE_TEST_SUITE_P(
    Each, Scores,
    testing::Values(
        Scored{"no_stones", {}, {0, 0}}, Scored{"one", {{a, 0.4}}, {1, 0}},
        Scored{"only_those_nearer_than_the_others_nearest", {{a, 0.1}, {a, 0.5}, {b, 0.6}, {a, 0.7}}, {2, 0}},
        Scored{"biting_counts", {{b, 1.97}}, {0, 1}}, Scored{"beside_the_house_does_not", {{b, 1.98}}, {0, 0}},
        Scored{"the_others_outside_the_house_hinder_nobody", {{a, 1.0}, {a, 1.9}, {b, 2.0}}, {2, 0}},
        Scored{"eight", {{b, 0.1}, {b, 0.2}, {b, 0.3}, {b, 0.4}, {b, 0.5}, {b, 0.6}, {b, 0.7}, {b, 0.8}}, {0, 8}},
        Scored{"equally_near_is_nobodys", {{a, 0.3}, {b, 0.3}}, {0, 0}}),
    [](const auto& scored) { return std::string(scored.param.what); });

std::vector<Lying> any_stones() {
  std::vector<Lying> stones;
  for (const Team team : {a, b}) {
    const auto count = *rc::gen::inRange(0, 9);
    for (int i = 0; i < count; ++i) stones.push_back({team, 1e-3 * *rc::gen::inRange(0, 3000)});
  }
  return stones;
}

/// The same by sorting: the first stone's team, up to the other team's first.
EndScore by_sorting(std::vector<Lying> stones) {
  std::erase_if(stones, [](const Lying& stone) { return stone.radius_m >= 1.829 + 0.145; });
  std::ranges::sort(stones, {}, &Lying::radius_m);
  EndScore points{};
  if (stones.empty()) return points;
  const Team leader = stones.front().team;
  const auto other = std::ranges::find_if(stones, [&](const Lying& stone) { return stone.team != leader; });
  points[side_of(leader)] = static_cast<int>(std::count_if(stones.begin(), stones.end(), [&](const Lying& stone) {
    return stone.team == leader && (other == stones.end() || stone.radius_m < other->radius_m);
  }));
  return points;
}

RC_GTEST_PROP(ScoreProperty, IsTheLeadOfOneTeamInTheOrderOfDistance, ()) {
  const std::vector<Lying> stones = any_stones();
  const EndScore points = score(board_of(stones));
  RC_ASSERT(points == by_sorting(stones));
  RC_ASSERT(points[0] == 0 || points[1] == 0);
}

RC_GTEST_PROP(ScoreProperty, AsksNeitherForNamesNorForOrderNorForSides, ()) {
  const Board board = board_of(any_stones());
  Board mirrored;
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < stones_each; ++i) {
      const auto& stone = board.stones[side][i];
      if (stone) mirrored.stones[1 - side][stones_each - 1 - i] = BoardStone{-stone->x_m, stone->y_m};
    }
  }
  const EndScore points = score(board);
  RC_ASSERT(score(mirrored) == (EndScore{points[1], points[0]}));
}

RC_GTEST_PROP(ScoreProperty, HoldsWithinItsMargin, ()) {
  std::vector<Lying> stones = any_stones();
  const Board board = board_of(stones);
  const double margin_m = score_margin_m(board);
  for (Lying& stone : stones) {
    stone.radius_m = std::max(0.0, stone.radius_m + 0.0049 * *rc::gen::inRange(-100, 100) * std::min(margin_m, 1.0));
  }
  RC_ASSERT(score(board_of(stones)) == score(board));
}

TEST(ScoreMargin, IsTheGapThatDecides) {
  struct Case {
    const char* what;
    std::vector<Lying> stones;
    double margin_m;
  };
  const std::vector<Case> cases{
      {"two nearest of different teams", {{Team::first, 0.30}, {Team::second, 0.35}, {Team::first, 1.0}}, 0.05},
      {"a second counting one, hardly", {{Team::first, 0.10}, {Team::first, 0.48}, {Team::second, 0.50}}, 0.02},
      {"one that bites the house, hardly", {{Team::first, 1.97}}, 0.004},
      {"one that does not bite it, hardly", {{Team::second, 1.98}}, 0.006},
  };
  for (const Case& c : cases) EXPECT_NEAR(score_margin_m(board_of(c.stones)), c.margin_m, 1e-9) << c.what;
  EXPECT_GT(score_margin_m({}), 1e6) << "of nothing there is nothing to measure";
}

}  // namespace
}  // namespace hogline::servo::test
