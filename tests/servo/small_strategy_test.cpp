#include "servo/small_strategy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "servo/game/rules.hpp"
#include "tests/servo/ice_session.hpp"

namespace hogline::servo::test {
namespace {

constexpr double tee_m = 38.405;

struct Standing {
  Team team;
  double x_m;
  double y_m;
};

/// The second team's turn, with eight of the sixteen thrown.
GameState turn_of_the_second(const std::vector<Standing>& stones, int shot = 7) {
  GameState state = new_game({});
  state.shot = shot;
  std::array<std::size_t, 2> next{};
  for (const Standing& stone : stones) {
    const std::size_t side = side_of(stone.team);
    state.board.stones[side][next[side]++] = BoardStone{stone.x_m, stone.y_m};
  }
  return state;
}

IceModel learnt_ice() { return IceModel({}, IceEstimate{1.08, 0.8, 1e-4, {1e-5, 0, 0, 0, 1e-3, 0, 0, 0, 1e-9}, 6}); }

struct Situation {
  const char* what;
  std::vector<Standing> stones;
  int shot;
  SmallPlan plan;
  double x_m;  ///< of what it shall come to
  double y_m;
};

class Situations : public testing::TestWithParam<Situation> {};

constexpr Team own = Team::second, other = Team::first;

TEST_P(Situations, HaveTheirPlan) {
  const Situation& given = GetParam();
  const SmallAnswer answer = small_strategy(turn_of_the_second(given.stones, given.shot), robot(), learnt_ice());
  ASSERT_TRUE(answer.ok) << answer.reason;
  EXPECT_EQ(name_of(answer.plan), name_of(given.plan));
  EXPECT_NEAR(answer.aim.place.x_m, given.x_m, 0.03);
  EXPECT_NEAR(answer.aim.place.y_m, given.y_m, 0.01);
  EXPECT_GT(answer.sigma_m, 0.0);
  // What is told comes to the same by FCV1, unless a stone is in that way.
  const IntendedOutcome told = intended_outcome(answer.told, {{}, 4.75});
  if (answer.plan != SmallPlan::take_out) {
    EXPECT_NEAR(told.place.y_m, answer.aim.place.y_m, 5e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, Situations,
    testing::Values(
        Situation{"an_empty_house", {}, 7, SmallPlan::draw, 0.0, tee_m},
        Situation{"its_first_with_the_hammer", {{other, 0.0, 34.2}}, 1, SmallPlan::guard, 1.1, 34.3},
        Situation{
            "its_first_and_a_stone_in_the_house", {{other, 0.2, tee_m}}, 1, SmallPlan::take_out, 0.2, tee_m - 0.29},
        Situation{"the_others_shot_stone", {{other, 0.3, tee_m}}, 7, SmallPlan::take_out, 0.3, tee_m - 0.29},
        Situation{"a_stone_outside_the_house", {{other, 0.9, 34.0}}, 7, SmallPlan::draw, 0.0, tee_m},
        Situation{"its_own_shot_stone", {{own, 0.1, tee_m + 0.2}}, 7, SmallPlan::guard, 0.1, tee_m - 2.4},
        Situation{"its_own_guarded_one", {{own, 0.4, tee_m}, {own, 0.4, tee_m - 2.6}}, 7, SmallPlan::draw, 0.0, tee_m},
        Situation{"its_own_and_the_last_throw", {{own, 0.6, tee_m}}, 15, SmallPlan::draw, 0.0, tee_m}),
    [](const auto& given) { return std::string(given.param.what); });

/// The first team's first throw, or the second team's last one, in a game of eight ends.
SmallAnswer answer_at(int end, int shot, int lead_of_first, const IceModel& ice = learnt_ice()) {
  GameSetting setting;
  setting.ends = 8;
  GameState state = new_game(setting);
  state.end = end;
  state.shot = shot;
  if (lead_of_first > 0) state.scores[0][0] = lead_of_first;
  if (lead_of_first < 0) state.scores[1][0] = -lead_of_first;
  return small_strategy(state, robot(), ice);
}

TEST(SmallStrategy, WhoHasNotTheHammerBeginsWithAGuardUnlessItLeads) {
  const SmallAnswer guard = answer_at(2, 0, 1);
  EXPECT_EQ(guard.plan, SmallPlan::guard);
  EXPECT_NEAR(guard.aim.place.x_m, 0.0, 1e-9);
  EXPECT_EQ(answer_at(2, 0, 2).plan, SmallPlan::draw);
  EXPECT_EQ(answer_at(2, 0, 0, IceModel({})).plan, SmallPlan::draw) << "on ice not known a guard may lie anywhere";
}

TEST(SmallStrategy, TheLastThrowToAnEmptyHouseKeepsTheHammerWhereThereAreEndsToCome) {
  EXPECT_EQ(answer_at(2, 15, 0).plan, SmallPlan::throw_away);
  EXPECT_EQ(answer_at(2, 15, 3).plan, SmallPlan::throw_away);
  EXPECT_EQ(answer_at(7, 15, 0).plan, SmallPlan::draw) << "the last end: a point wins";
  EXPECT_EQ(answer_at(7, 15, 1).plan, SmallPlan::draw) << "... or draws level";
  EXPECT_EQ(answer_at(7, 15, -1).plan, SmallPlan::throw_away) << "it has won";
  EXPECT_EQ(answer_at(8, 15, 0).plan, SmallPlan::draw) << "an extra end";
}

TEST(SmallStrategy, SaysWhyWhenNothingCanBeThrown) {
  ThrowerSkill weak = robot();
  weak.max_speed_mps = 1.0;
  const SmallAnswer answer = small_strategy(turn_of_the_second({}), weak, learnt_ice());
  EXPECT_FALSE(answer.ok);
  EXPECT_EQ(answer.reason, "the thrower is not fast enough");
}

// The way to a full hit leads into the stone's middle.
TEST(SmallStrategy, ItsHitsAreFull) {
  const SmallAnswer answer = small_strategy(turn_of_the_second({{other, -0.5, tee_m + 0.3}}), robot(), learnt_ice());
  ASSERT_TRUE(answer.ok);
  const double along = std::atan2(-(-0.5 - answer.aim.place.x_m), tee_m + 0.3 - answer.aim.place.y_m);
  EXPECT_NEAR(along, answer.aim.heading_rad, 1e-3);
}

}  // namespace
}  // namespace hogline::servo::test
