// Whole turns of both robots on the simulated rink, seen by the oracle.
#include "src/team/robots_throw.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/src/team/practice_team.hpp"

namespace hogline::test {
namespace {

using game::ThrowEnd;

/// A draw by the first team on a house with one stone in it.
struct OneTurn {
  explicit OneTurn(std::uint64_t seed)
      : team(practice_team(seed)),
        robots(
            team, skill_of(team.request().thrower), servo::IceModel({}), [this](const TurnRecord& r) { record = r; },
            [this](double, const std::string& what) { stages.push_back(what); }) {
    turn.board.stones[1][0] = servo::BoardStone{0.9, servo::in_sheet::tee_y_m - 0.3, 0.0};
    turn.stone = 0;
    turn.decision.order = servo::ShotOrder{.speed_mps = 2.05, .heading_rad = -0.03, .spin_radps = 1.5};
    team.crew().lay(turn.board);
  }
  /// `interfere` is called once a second of the rink's.
  game::ThrowReport play(const std::function<void(OneTurn&)>& interfere = {}) {
    robots.start(turn, {});
    for (int i = 0; i < 600; ++i) {
      if (interfere) interfere(*this);
      if (const auto report = robots.step({})) return *report;
    }
    ADD_FAILURE() << "the turn does not end";
    return {};
  }
  bool running() {
    const ThrowerLoop* loop = team.thrower().loop();
    return team.thrower().throwing() && loop->thrower().state() == servo::ThrowerState::run;
  }

  SimulatedTeam team;
  RobotsThrow robots;
  game::Turn turn;
  TurnRecord record;
  std::vector<std::string> stages;
};

TEST(RobotsThrow, ATurnFromTheLookToTheCount) {
  OneTurn one(2);
  const game::ThrowReport report = one.play();
  ASSERT_EQ(report.end, ThrowEnd::thrown) << report.reason;
  EXPECT_EQ(one.record.attempts, 1);
  EXPECT_TRUE(one.record.remarks.empty());
  ASSERT_TRUE(one.record.release && one.record.followed && one.record.counted);
  EXPECT_TRUE(one.record.followed->ok) << one.record.followed->reason;

  // The stone let go is the one followed: the message against the truth.
  const auto& truth = one.record.truth;
  EXPECT_NEAR(one.record.release->speed_mps, servo::speed_mps(truth.let_go), 0.02);
  EXPECT_NEAR(one.record.release->lateral_m, truth.let_go.x_m, 0.02);
  ASSERT_TRUE(one.record.thrower.release);
  EXPECT_LT(std::abs(one.record.thrower.release->lateral_error_m), 0.02) << "let go on its line through the hack";

  for (const StoneName name : {StoneName{0, 0}, StoneName{1, 0}}) {
    const auto& seen = report.seen.lying.stones[name.side][name.stone];
    const auto& there = truth.stones.lying.stones[name.side][name.stone];
    ASSERT_TRUE(seen && there);
    EXPECT_LT(std::hypot(seen->x_m - there->x_m, seen->y_m - there->y_m), 0.02);
  }
  ASSERT_TRUE(report.trajectory);
  servo::Board replayed = report.trajectory->start;
  for (const auto& frame : report.trajectory->frames)
    for (const auto& change : frame) replayed.stones[servo::side_of(change.team)][change.stone] = change.now;
  EXPECT_EQ(replayed, report.seen.lying) << "its frames lead to where the stones lie";
  EXPECT_EQ(one.robots.ice().estimate().throws, 1) << "the ice model has learnt";
  EXPECT_NEAR(one.robots.ice().estimate().friction_scale, one.team.request().scenario.stone.friction_scale, 0.03);
}

TEST(RobotsThrow, TheSameSeedIsTheSameTurn) {
  OneTurn one(5), two(5);
  const auto a = one.play(), b = two.play();
  EXPECT_EQ(a.seen.lying, b.seen.lying);
  EXPECT_EQ(one.record.truth.stones.lying, two.record.truth.stones.lying);
  EXPECT_EQ(one.stages, two.stages);
}

struct Fault {
  const char* name;
  void (*strike)(SimulatedTeam&);
  void (*mend)(SimulatedTeam&);
};

class Faults : public testing::TestWithParam<Fault> {};

// Whoever of the two fails before the release: the run stops with the stone held, and is repeated when all is well.
TEST_P(Faults, InTheRunKeepTheStoneAndTheThrowIsRepeated) {
  OneTurn one(3);
  bool struck = false, mended = false;
  const auto report = one.play([&](OneTurn& t) {
    if (!struck && t.running()) {
      GetParam().strike(t.team);
      struck = true;
    } else if (struck && !mended && !t.team.thrower().throwing()) {
      EXPECT_FALSE(t.team.crew().stone_is_gone()) << "nothing was let go after the fault";
      GetParam().mend(t.team);
      mended = true;
    }
  });
  ASSERT_TRUE(struck && mended);
  EXPECT_EQ(report.end, ThrowEnd::thrown) << report.reason;
  EXPECT_GE(one.record.attempts, 2);
  EXPECT_FALSE(one.record.remarks.empty()) << "and it is said why";
}

auto& thrower_wheel(SimulatedTeam& team) { return team.robot().rink().left_drive().communication().faults; }
auto& skip_pan(SimulatedTeam& team) { return team.skip_robot().rink().pan_drive().communication().faults; }

constexpr Fault faults[] = {{"thrower_drive", [](SimulatedTeam& team) { thrower_wheel(team).heartbeat_stopped = true; },
                             [](SimulatedTeam& team) { thrower_wheel(team).heartbeat_stopped = false; }},
                            {"skip_head", [](SimulatedTeam& team) { skip_pan(team).heartbeat_stopped = true; },
                             [](SimulatedTeam& team) { skip_pan(team).heartbeat_stopped = false; }}};

INSTANTIATE_TEST_SUITE_P(Of, Faults, testing::ValuesIn(faults),
                         [](const auto& fault) { return std::string(fault.param.name); });

TEST(RobotsThrow, AThrowThatFailsAgainAndAgainStopsTheGame) {
  OneTurn one(3);
  const auto report = one.play([](OneTurn& t) {
    if (t.running()) t.team.robot().operator_switch().hold(false);
    if (!t.team.thrower().throwing()) t.team.robot().operator_switch().hold(true);
  });
  EXPECT_EQ(report.end, ThrowEnd::failed);
  EXPECT_EQ(one.record.attempts, 3);
  EXPECT_NE(report.reason.find("switch"), std::string::npos) << report.reason;
  EXPECT_FALSE(one.record.truth.released);
}

TEST(RobotsThrow, ALostStoneIsNotThrownAgain) {
  OneTurn one(4);
  bool struck = false;
  const auto report = one.play([&](OneTurn& t) {
    if (!struck && t.running()) {
      t.team.robot().rink().modbus().inject([](auto& jaws, auto&, auto&) { jaws.lose_stone(); });
      struck = true;
    }
  });
  ASSERT_TRUE(struck);
  EXPECT_EQ(report.end, ThrowEnd::thrown) << report.reason;
  EXPECT_EQ(one.record.attempts, 1);
  const auto& lost = report.seen.lying.stones[0][0];
  EXPECT_TRUE(!lost || !servo::past_hog_line(*lost)) << "wherever it is seen: short of the hog line, and so out";
  EXPECT_TRUE(report.seen.lying.stones[1][0]) << "the other one stands";
}

}  // namespace
}  // namespace hogline::test
