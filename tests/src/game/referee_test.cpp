#include "src/game/referee.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "src/game/built_in_strategist.hpp"
#include "src/game/game_journal.hpp"
#include "tests/src/game/ice_table.hpp"

namespace hogline::game::test {
namespace {

/// Does as it is told to.
class Scripted : public hw::Strategist {
 public:
  explicit Scripted(Team team) : team_(team) { state_.phase = hw::StrategistPhase::ready; }
  void begin(const std::array<std::string, servo::team_count>&, Stamp) override {
    state_.phase = hw::StrategistPhase::waiting;
  }
  void tell(const servo::GameUpdate& update, Stamp) override {
    if (state_.phase == hw::StrategistPhase::failed) return;
    const auto next = next_team(update.state);
    state_.decision.reset();
    state_.phase = !next           ? hw::StrategistPhase::over
                   : next == team_ ? hw::StrategistPhase::thinking
                                   : hw::StrategistPhase::waiting;
  }
  void step(Stamp) override {}
  const hw::StrategistState& state() const override { return state_; }

  void decide(const servo::GameMove& move, Duration thought = Duration::zero()) {
    state_.phase = hw::StrategistPhase::decided;
    state_.decision = hw::StrategistDecision{.move = move, .thought = thought};
  }
  void end(hw::StrategistPhase phase, const std::string& reason) {
    state_.phase = phase;
    state_.reason = reason;
    state_.decision.reset();
  }

 private:
  Team team_;
  hw::StrategistState state_;
};

struct Table {
  Scripted first{Team::first}, second{Team::second};
  SimulatedThrows throws = exact_throws();
  Witness witness;
  servo::GameSetting setting = setting_of(1);
  Referee referee{setting, {&first, &second}, throws, witness};
  Stamp now{std::chrono::seconds(1)};

  void steps(int count) {
    for (int i = 0; i < count; ++i) referee.step(now += 10ms);
  }
};

constexpr servo::HackShot draw{0.132, 2.3995, servo::Curl::counter_clockwise};

TEST(Referee, AsksThrowsJudgesAndAsksTheOther) {
  Table table;
  table.steps(3);
  EXPECT_EQ(table.referee.phase(), RefereePhase::asking);
  EXPECT_TRUE(table.witness.reports.empty()) << "nobody has decided";
  table.first.decide(draw, 7s);
  table.steps(2);
  ASSERT_EQ(table.witness.reports.size(), 1u);
  EXPECT_EQ(table.witness.reports[0].end, ThrowEnd::thrown) << table.witness.reports[0].reason;
  EXPECT_EQ(table.referee.state().shot, 1);
  EXPECT_EQ(table.referee.state().thinking_left[0], Duration(593s));
  EXPECT_TRUE(table.referee.state().board.stones[0][0]);
  table.steps(5);
  EXPECT_EQ(table.witness.reports.size(), 1u);
}

TEST(Referee, AShotThatCanNotBeThrownIsGivenAway) {
  Table table;
  table.steps(2);
  table.first.decide(servo::HackShot{0.0, 4.5, servo::Curl::clockwise});
  table.steps(2);
  ASSERT_EQ(table.witness.reports.size(), 1u);
  EXPECT_EQ(table.witness.reports[0].end, ThrowEnd::refused);
  EXPECT_EQ(table.witness.reports[0].reason, "the thrower is not fast enough");
  EXPECT_EQ(table.referee.state().shot, 1);
  EXPECT_EQ(table.referee.state().board, servo::Board{});
}

TEST(Referee, WhoConcedesOrIsLateLosesWithoutAThrow) {
  Table conceding;
  conceding.steps(2);
  conceding.first.decide(servo::Concession{});
  conceding.steps(2);
  EXPECT_EQ(conceding.referee.phase(), RefereePhase::over);
  EXPECT_EQ(conceding.referee.state().result->winner, Team::second);
  Table late;
  late.steps(2);
  late.first.end(hw::StrategistPhase::late, "too late");
  late.steps(2);
  ASSERT_EQ(late.referee.phase(), RefereePhase::over);
  EXPECT_EQ(late.referee.state().result->reason, servo::GameReason::time_limit);
  EXPECT_EQ(late.referee.reason(), "too late");
  EXPECT_TRUE(conceding.witness.reports.empty() && late.witness.reports.empty());
}

TEST(Referee, AStrategistThatFailsStopsTheGameAlsoInTheOthersTurn) {
  Table table;
  table.steps(2);
  table.second.end(hw::StrategistPhase::failed, "it vanished");
  table.first.decide(draw);
  table.steps(3);
  EXPECT_EQ(table.referee.phase(), RefereePhase::stopped);
  EXPECT_EQ(table.witness.stops, std::vector<std::string>{"it vanished"});
  EXPECT_TRUE(table.witness.reports.empty());
}

TEST(Referee, AStoneThatRunsIsFollowedToItsEndThoughAStrategistHasFailed) {
  Table table;
  table.steps(1);
  table.first.decide(draw);
  table.steps(1);
  ASSERT_EQ(table.referee.phase(), RefereePhase::throwing);
  table.second.end(hw::StrategistPhase::failed, "it vanished");
  table.steps(2);
  EXPECT_EQ(table.referee.phase(), RefereePhase::stopped);
  EXPECT_EQ(table.referee.reason(), "it vanished");
  ASSERT_EQ(table.witness.reports.size(), 1u);
  EXPECT_EQ(table.witness.reports[0].end, ThrowEnd::thrown);
}

using nlohmann::json;

/// A game of the built-in strategist against itself, on ice that nobody knows at first.
struct OwnGame {
  explicit OwnGame(std::uint64_t seed, int ends)
      : setting(setting_of(ends)),
        throws(any_sheet(seed), robot(), servo::IceModel({}), seed),
        first(Team::first, robot(), [this] { return throws.ice(); }),
        second(Team::second, robot(), [this] { return throws.ice(); }),
        log(record, [] { return std::string("2026-11-22T10:05:00+00:00"); }),
        journal([this](const std::string& line) { events.push_back(json::parse(line)); }, log,
                {"id", "2026-11-22T10:05:00+00:00"}, {setting, {}}, [] { return GameJournal::PlayerOrders{}; }),
        referee(setting, {&first, &second}, throws, journal) {
    Stamp now{std::chrono::seconds(1)};
    const auto goes_on = [&] {
      return referee.phase() != RefereePhase::over && referee.phase() != RefereePhase::stopped;
    };
    while (goes_on()) referee.step(now += 10ms);
  }

  servo::GameSetting setting;
  SimulatedThrows throws;
  BuiltInStrategist first, second;
  std::ostringstream record;
  hw::digital_curling::GameLog log;
  std::vector<json> events;
  GameJournal journal;
  Referee referee;
};

/// What the journal says of an end in which the second team's stone lies so much farther from the tee than the first's.
json end_of(double farther_m, double seen_sigma_m) {
  json told;
  std::ostringstream record;
  hw::digital_curling::GameLog log(record, [] { return std::string(); });
  GameJournal journal([&](const std::string& line) { told = json::parse(line); }, log, {}, {},
                      [] { return GameJournal::PlayerOrders{}; });
  servo::Judged judged;
  judged.board.stones[0][0] = servo::BoardStone{0.5, servo::in_sheet::tee_y_m, 0.0};
  judged.board.stones[1][0] = servo::BoardStone{-0.5 - farther_m, servo::in_sheet::tee_y_m, 0.0};
  judged.end = servo::EndScore{1, 0};
  ThrowReport report;
  report.end = ThrowEnd::thrown;
  report.seen_sigma_m = seen_sigma_m;
  journal.thrown({}, report, judged);
  return told;
}

// On ice an official measures what nobody can tell by eye: the skip has to say that it can not.
TEST(GameJournal, SaysWhichEndsAreToBeMeasured) {
  EXPECT_TRUE(end_of(0.002, 0.003)["measure"]);
  EXPECT_NEAR(end_of(0.002, 0.003)["margin_m"].get<double>(), 0.002, 1e-9);
  EXPECT_FALSE(end_of(0.002, 0.0005)["measure"]) << "seen well enough";
  EXPECT_FALSE(end_of(0.05, 0.003)["measure"]);
}

double from_tee(const json& stone) {
  return std::hypot(stone["x_m"].get<double>(), stone["y_m"].get<double>() - 38.405);
}

constexpr double biting_m = 1.829 + 0.145;

/// An end's points from the places alone.
std::array<int, 2> counted(const json& board) {
  std::array<double, 2> nearest{biting_m, biting_m};
  for (const json& stone : board) {
    double& best = nearest[stone["team"] == "team0" ? 0 : 1];
    best = std::min(best, from_tee(stone));
  }
  std::array<int, 2> points{};
  for (const json& stone : board) {
    const std::size_t side = stone["team"] == "team0" ? 0 : 1;
    points[side] += from_tee(stone) < nearest[1 - side] ? 1 : 0;
  }
  return points;
}

bool in_the_house(const json& event) {
  return std::ranges::any_of(event["board"], [&](const json& stone) {
    return stone["team"] == event["team"] && stone["stone"] == event["shot"].get<int>() / 2 &&
           from_tee(stone) < biting_m;
  });
}

struct Tally {
  int ends = 0, draws = 0, in_house = 0;
  std::array<int, 2> points{};
};

Tally tally_of(const OwnGame& game) {
  Tally tally;
  for (const json& event : game.events) {
    if (event["event"] != "throw") continue;
    if (event["plan"] == "draw") {
      ++tally.draws;
      tally.in_house += in_the_house(event) ? 1 : 0;
    }
    if (!event.contains("end_score")) continue;
    ++tally.ends;
    const auto points = counted(event["board"]);
    EXPECT_EQ(event["end_score"].get<decltype(tally.points)>(), points);
    for (const std::size_t side : {0u, 1u}) tally.points[side] += points[side];
  }
  return tally;
}

TEST(BuiltInGame, TwentyEndsScoreAsTheSimulatorsStonesLie) {
  Tally all;
  for (std::uint64_t seed = 1; all.ends < 20; ++seed) {
    const OwnGame game(seed, 4);
    ASSERT_EQ(game.referee.phase(), RefereePhase::over) << game.referee.reason();
    const Tally tally = tally_of(game);
    EXPECT_EQ(game.events.back()["score"].get<decltype(tally.points)>(), tally.points);
    all.ends += tally.ends;
    all.draws += tally.draws;
    all.in_house += tally.in_house;
  }
  std::printf("%d ends, %d of %d draws in the house\n", all.ends, all.in_house, all.draws);
  EXPECT_GT(all.in_house, all.draws * 7 / 10) << "the ice is learnt";
}

TEST(BuiltInGame, ItsRecordHasEveryUpdateAndMove) {
  const OwnGame game(2, 1);
  std::istringstream entries(game.record.str());
  int id = 0, updates = 0, moves = 0;
  std::string last;
  for (std::string line; std::getline(entries, line); ++id) {
    const json entry = json::parse(line);
    EXPECT_EQ(entry["id"], id);
    EXPECT_EQ(entry["tag"], "gam");
    last = entry["log"]["cmd"];
    updates += last == "update" ? 1 : 0;
    moves += last == "move" ? 1 : 0;
  }
  EXPECT_EQ(last, "game_over");
  EXPECT_GE(moves, 16);
  EXPECT_EQ(updates, moves + 1);
}

TEST(BuiltInGame, TheSameSeedPlaysTheSameGame) { EXPECT_EQ(OwnGame(5, 1).events, OwnGame(5, 1).events); }

}  // namespace
}  // namespace hogline::game::test
