#include "servo/game/rules.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace hogline::servo::test {
namespace {

using namespace std::chrono_literals;

constexpr double tee_m = 38.405;
constexpr Team a = Team::first, b = Team::second;

GameSetting ends(int count) {
  GameSetting setting;
  setting.ends = count;
  setting.thinking = {60s, 50s};
  setting.extra_thinking = {20s, 10s};
  return setting;
}

/// The thrown stone comes to lie there; all others stay.
ThrownStones draw_to(const GameState& state, BoardStone place) {
  ThrownStones seen{.lying = state.board};
  seen.lying.stones[side_of(*next_team(state))][next_stone(state)] = place;
  return seen;
}

/// It leaves the sheet; all others stay.
ThrownStones thrown_away(const GameState& state) { return {.lying = state.board}; }

/// An end in which one stone of a team, or of nobody, stays in the house.
GameState played_end(GameState state, std::optional<Team> scorer, const GameSetting& setting) {
  bool placed = !scorer;
  for (int shot = 0; shot < stones_an_end; ++shot) {
    const bool now = !placed && next_team(state) == scorer;
    const Judged judged = judge(state, now ? draw_to(state, {0.0, tee_m}) : thrown_away(state), setting);
    EXPECT_TRUE(judged.ok) << judged.reason;
    placed = placed || now;
    state = judged.state;
  }
  return state;
}

TEST(Game, BeginsWithTheTeamWithoutTheHammer) {
  const GameState state = new_game(ends(8));
  EXPECT_EQ(state.hammer, b);
  EXPECT_EQ(next_team(state), a);
  EXPECT_EQ(state.scores[0].size(), 8u);
  EXPECT_EQ(state.thinking_left[1], Duration(50s));
}

TEST(Game, TheTeamsThrowInTurnsEachItsEightStones) {
  const GameSetting setting = ends(2);
  GameState state = new_game(setting);
  for (int shot = 0; shot < stones_an_end; ++shot) {
    EXPECT_EQ(state.shot, shot);
    EXPECT_EQ(next_team(state), shot % 2 == 0 ? a : b);
    EXPECT_EQ(next_stone(state), static_cast<std::size_t>(shot / 2));
    const Judged judged = judge(state, thrown_away(state), setting);
    ASSERT_TRUE(judged.ok);
    EXPECT_EQ(judged.end.has_value(), shot == 15);
    state = judged.state;
  }
  EXPECT_EQ(state.end, 1);
  EXPECT_EQ(state.shot, 0);
}

struct Ends {
  const char* what;
  std::vector<std::optional<Team>> scorers;  ///< of each end
  std::optional<Team> hammer;                ///< after them; nothing when the game is over
  std::optional<Team> winner;
};

class PlayedEnds : public testing::TestWithParam<Ends> {};

// Games of two ends.
TEST_P(PlayedEnds, HandOnTheHammerAndEndTheGame) {
  const GameSetting setting = ends(2);
  GameState state = new_game(setting);
  for (const auto& scorer : GetParam().scorers) {
    ASSERT_FALSE(state.result);
    state = played_end(state, scorer, setting);
  }
  EXPECT_EQ(state.hammer, GetParam().hammer);
  EXPECT_EQ(state.end, static_cast<int>(GetParam().scorers.size()));
  ASSERT_EQ(state.result.has_value(), !GetParam().hammer);
  if (state.result) {
    EXPECT_EQ(state.result->winner, GetParam().winner);
    EXPECT_EQ(state.result->reason, GameReason::score);
    EXPECT_FALSE(next_team(state));
  }
}

constexpr std::nullopt_t nobody = std::nullopt;

INSTANTIATE_TEST_SUITE_P(
    Each, PlayedEnds,
    testing::Values(Ends{"the_scorer_loses_the_hammer", {b}, a, {}},
                    Ends{"a_steal_keeps_it_with_the_other", {a}, b, {}}, Ends{"a_blank_end_keeps_it", {nobody}, b, {}},
                    Ends{"the_higher_score_wins", {a, a}, {}, a}, Ends{"blank_and_one", {nobody, b}, {}, b},
                    Ends{"level_goes_on", {a, b}, a, {}}, Ends{"an_extra_end_decides", {a, b, b}, {}, b},
                    Ends{"a_blank_extra_end_is_followed_by_another", {a, b, nobody}, a, {}},
                    Ends{"which_decides", {nobody, nobody, nobody, a}, {}, a}),
    [](const auto& played) { return std::string(played.param.what); });

TEST(Game, AnExtraEndIsWrittenDownApartAndHasItsOwnTime) {
  const GameSetting setting = ends(1);
  GameState state = played_end(thought(new_game(setting), 30s), nobody, setting);
  EXPECT_EQ(state.thinking_left[0], Duration(20s));
  EXPECT_EQ(state.thinking_left[1], Duration(10s));
  state = played_end(thought(state, 5s), nobody, setting);
  EXPECT_EQ(state.thinking_left[0], Duration(20s)) << "each extra end's is new";
  EXPECT_FALSE(state.extra_score[0]);
  state = played_end(state, b, setting);
  EXPECT_EQ(state.scores[1], (std::vector<std::optional<int>>{0}));
  EXPECT_EQ(state.extra_score[0], 0);
  EXPECT_EQ(state.extra_score[1], 1);
  EXPECT_EQ(total(state, b), 1);
}

TEST(Game, LevelAfterAllThatMayBePlayedIsADraw) {
  GameSetting setting = ends(1);
  setting.most_ends = 2;
  GameState state = played_end(played_end(new_game(setting), nobody, setting), nobody, setting);
  ASSERT_TRUE(state.result);
  EXPECT_FALSE(state.result->winner);
  EXPECT_EQ(state.result->reason, GameReason::draw);
}

struct GuardThrow {
  const char* what;
  int shot;          ///< from 0: of the throw that takes the stone away
  BoardStone guard;  ///< which the other team threw just before
  int protected_throws;
  bool foul;
};

class FreeGuards : public testing::TestWithParam<GuardThrow> {};

TEST_P(FreeGuards, AreProtectedBeforeTheSixthStone) {
  GameSetting setting = ends(1);
  setting.protected_throws = GetParam().protected_throws;
  GameState state = new_game(setting);
  while (state.shot + 1 < GetParam().shot) state = judge(state, thrown_away(state), setting).state;
  state = judge(state, draw_to(state, GetParam().guard), setting).state;
  ASSERT_EQ(state.shot, GetParam().shot);
  // The guard is driven out, and the thrown stone stays where it was.
  ThrownStones seen{.lying = {}, .struck = true};
  seen.lying.stones[side_of(*next_team(state))][next_stone(state)] = BoardStone{0.3, 36.0};
  const Judged judged = judge(state, seen, setting);
  ASSERT_TRUE(judged.ok);
  EXPECT_EQ(judged.free_guard_zone_foul, GetParam().foul);
  EXPECT_EQ(judged.board == state.board, GetParam().foul) << "a foul: all as before, without the thrown stone";
  EXPECT_EQ(judged.state.shot, GetParam().shot + 1);
}

constexpr BoardStone guard{0.0, 35.0}, in_the_house{0.0, 37.5};

INSTANTIATE_TEST_SUITE_P(Each, FreeGuards,
                         testing::Values(GuardThrow{"second_stone", 1, guard, 5, true},
                                         GuardThrow{"fifth_stone", 4, guard, 5, true},
                                         GuardThrow{"sixth_stone", 5, guard, 5, false},
                                         GuardThrow{"fifth_of_four", 4, guard, 4, false},
                                         GuardThrow{"not_of_a_stone_in_the_house", 1, in_the_house, 5, false}),
                         [](const auto& each) { return std::string(each.param.what); });

TEST(FreeGuards, OnesOwnGuardMayBeTakenAwayAndAnyMayBeMoved) {
  const GameSetting setting = ends(1);
  GameState state = new_game(setting);
  state = judge(state, draw_to(state, guard), setting).state;        // a's
  state = judge(state, draw_to(state, {0.5, 34.0}), setting).state;  // b's
  ThrownStones seen{.lying = {}, .struck = true};
  seen.lying.stones[1][0] = BoardStone{1.5, 37.0};  // b's was ticked aside, a's own is gone
  const Judged judged = judge(state, seen, setting);
  ASSERT_TRUE(judged.ok);
  EXPECT_FALSE(judged.free_guard_zone_foul);
  EXPECT_FALSE(judged.board.stones[0][0]);
}

TEST(FreeGuards, AFoulPutsEveryStoneBack) {
  const GameSetting setting = ends(1);
  GameState state = new_game(setting);
  state = judge(state, draw_to(state, guard), setting).state;
  state = judge(state, draw_to(state, {0.0, tee_m}), setting).state;
  state = judge(state, draw_to(state, {0.4, tee_m}), setting).state;  // b throws the fourth stone
  ThrownStones seen{.lying = state.board, .struck = true};
  seen.lying.stones[0][0].reset();
  seen.lying.stones[0][1] = BoardStone{1.0, 39.0};
  seen.lying.stones[1][0] = BoardStone{-1.0, 39.0};
  seen.lying.stones[1][1] = BoardStone{0.0, 37.0};
  const Judged judged = judge(state, seen, setting);
  EXPECT_TRUE(judged.free_guard_zone_foul);
  EXPECT_EQ(judged.board, state.board);
  EXPECT_TRUE(judged.removed.empty());
}

struct OneThrow {
  const char* what;
  BoardStone place;
  bool struck;
  std::optional<OutOfPlay> why;
};

class OneThrown : public testing::TestWithParam<OneThrow> {};

TEST_P(OneThrown, StoneIsTakenAwayWhereItMayNotLie) {
  const GameSetting setting = ends(1);
  const GameState state = new_game(setting);
  ThrownStones seen = draw_to(state, GetParam().place);
  seen.struck = GetParam().struck;
  const Judged judged = judge(state, seen, setting);
  ASSERT_TRUE(judged.ok);
  EXPECT_EQ(judged.board.stones[0][0].has_value(), !GetParam().why);
  ASSERT_EQ(judged.removed.size(), GetParam().why ? 1u : 0u);
  if (GetParam().why) {
    EXPECT_EQ(judged.removed[0].why, *GetParam().why);
    EXPECT_EQ(judged.removed[0].team, a);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, OneThrown,
                         testing::Values(OneThrow{"hogged", {0.0, 32.1}, false, OutOfPlay::hogged},
                                         OneThrow{"short_but_it_hit_another", {0.0, 32.1}, true, {}},
                                         OneThrow{"over_the_hog_line", {0.0, 32.2}, false, {}},
                                         OneThrow{"through", {0.0, 41.0}, false, OutOfPlay::through},
                                         OneThrow{"at_the_side", {2.3, 36.0}, false, OutOfPlay::sideline},
                                         OneThrow{"biting_the_back_line", {0.0, 40.3}, false, {}}),
                         [](const auto& each) { return std::string(each.param.what); });

TEST(Game, ASheetWithoutSidelinesHasNoneToTouch) {
  GameSetting setting = ends(1);
  setting.sheet_width_m.reset();
  const GameState state = new_game(setting);
  EXPECT_TRUE(judge(state, draw_to(state, {2.4, 36.0}), setting).board.stones[0][0]);
}

TEST(Game, WhatCanNotHaveBeenSeenIsRefused) {
  const GameSetting setting = ends(1);
  const GameState state = new_game(setting);
  ThrownStones ghost = draw_to(state, {0.0, tee_m});
  ghost.lying.stones[1][3] = BoardStone{0.5, tee_m};
  Judged judged = judge(state, ghost, setting);
  EXPECT_FALSE(judged.ok);
  EXPECT_EQ(judged.reason, "a stone lies there that was not in play");
  EXPECT_EQ(judged.state.shot, 0) << "nothing has changed";
  judged = judge(state, draw_to(state, {std::numeric_limits<double>::quiet_NaN(), tee_m}), setting);
  EXPECT_EQ(judged.reason, "a stone's place is not finite");
}

TEST(Game, ThinkingCountsAgainstTheTeamThatThinks) {
  const GameState state = thought(new_game(ends(1)), 59999ms);
  EXPECT_EQ(state.thinking_left[0], Duration(1ms));
  EXPECT_EQ(state.thinking_left[1], Duration(50s));
  const GameState late = thought(state, 1ms);
  ASSERT_TRUE(late.result);
  EXPECT_EQ(late.result->winner, b);
  EXPECT_EQ(late.result->reason, GameReason::time_limit);
  EXPECT_EQ(late.thinking_left[0], Duration::zero());
}

TEST(Game, WhoConcedesHasLost) {
  const GameSetting setting = ends(4);
  const GameState state = conceded(judge(new_game(setting), thrown_away(new_game(setting)), setting).state);
  ASSERT_TRUE(state.result);
  EXPECT_EQ(state.result->winner, a) << "it was the second team's turn";
  EXPECT_EQ(state.result->reason, GameReason::concede);
}

BoardStone anywhere() { return {1e-3 * *rc::gen::inRange(-2500, 2500), 30.0 + 1e-3 * *rc::gen::inRange(0, 12000)}; }

/// Any stones of those that could lie there after a throw.
ThrownStones any_outcome(const GameState& state) {
  ThrownStones seen{.lying = state.board, .struck = *rc::gen::arbitrary<bool>()};
  for (auto& team : seen.lying.stones) {
    for (auto& stone : team) {
      if (!stone) continue;
      const int fate = *rc::gen::inRange(0, 8);
      if (fate == 0) stone.reset();
      if (fate == 1) stone = anywhere();
    }
  }
  if (*rc::gen::inRange(0, 4) != 0) seen.lying.stones[side_of(*next_team(state))][next_stone(state)] = anywhere();
  return seen;
}

void holds(const GameState& before, const Judged& judged, const GameSetting& setting) {
  RC_ASSERT(judged.ok);
  for (const auto& team : judged.board.stones) {
    for (const auto& stone : team) {
      if (!stone) continue;
      RC_ASSERT(!touches_sideline(*stone, 4.75));
      RC_ASSERT(!past_back_line(*stone));
    }
  }
  const GameState& after = judged.state;
  RC_ASSERT(after.end * 16 + after.shot == before.end * 16 + before.shot + 1);
  RC_ASSERT(judged.free_guard_zone_foul == (judged.free_guard_zone_foul && before.shot < 5));
  if (judged.free_guard_zone_foul) RC_ASSERT(judged.board == before.board);
  RC_ASSERT(judged.end.has_value() == (after.shot == 0));
  if (!judged.end) {
    RC_ASSERT(after.board == judged.board);
    RC_ASSERT(*next_team(after) == opponent_of(*next_team(before)));
    return;
  }
  RC_ASSERT(*judged.end == score(judged.board));
  RC_ASSERT(after.board == Board{});
  const bool scored = *judged.end != EndScore{0, 0};
  if (!after.result) RC_ASSERT(after.hammer == (scored ? opponent_of((*judged.end)[0] > 0 ? a : b) : *before.hammer));
  for (const Team team : {a, b}) RC_ASSERT(total(after, team) == total(before, team) + (*judged.end)[side_of(team)]);
  RC_ASSERT(after.result.has_value() == (after.end >= setting.ends && total(after, a) != total(after, b)));
}

RC_GTEST_PROP(GameProperty, HoldsItsLawsWhateverHappens, ()) {
  const GameSetting setting = ends(*rc::gen::inRange(1, 4));
  GameState state = new_game(setting);
  for (int i = 0; i < 16 * 5 && !state.result; ++i) {
    const Judged judged = judge(state, any_outcome(state), setting);
    holds(state, judged, setting);
    state = judged.state;
  }
}

}  // namespace
}  // namespace hogline::servo::test
