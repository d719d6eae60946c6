// A game on their own ice: rink, thrower, skip and two Digital Curling clients as programs of their own. One stone
// after the other is decided, laid, ordered, thrown, followed, counted and told to the clients, who check all that they
// are told; the second one is ordered by what the first has taught of the ice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/src/live/team_scene.hpp"

namespace hogline::live_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr Duration patience = 60s;
constexpr Duration stone_limit = 150s;  // three attempts on a busy machine
constexpr double tee_y_m = 38.405;      // of Digital Curling's board; the skip's e lies there turned around
constexpr int sittings = 4;

std::vector<json> throws_in(const std::filesystem::path& folder) {
  std::vector<json> throws;
  std::ifstream file(folder / "game.jsonl");
  for (std::string line; std::getline(file, line);) {
    json event = json::parse(line, nullptr, false);
    if (event.is_object() && event.value("event", "") == "throw") throws.push_back(std::move(event));
  }
  return throws;
}

struct LiveGame : testing::Test {
  TeamScene scene{HOGLINE_PROGRAM, {.whole_skip = true, .strategists = 2, .strategist_waits = false}};
  std::vector<std::filesystem::path> records;
  bool unexplained = false;  ///< something was given up that no slow machine explains

  std::string words() { return all_of(scene.rink()) + all_of(scene.thrower()) + all_of(scene.skip()); }

  std::vector<Told> skip_told(Stamp since, const std::string& event) {
    std::vector<Told> all = scene.skip().told();
    std::erase_if(all, [&](const Told& t) { return t.at < since || t.event != event; });
    return all;
  }
  // Plays, or goes on where it stood.
  void play() {
    const Stamp begin = now();
    ASSERT_TRUE(scene.begin_game()) << words();
    const std::string table = scene.skip().told_since(begin, "table")->what;
    records.emplace_back(table.substr(table.find("record is in ") + 13));
  }
  // A throw, or a look of the skip's, was given up: whether the machine explains it.
  void note_given_up(Stamp since) {
    const bool late = scene.was_late(since, now());
    if (!late) std::printf("given up, and not for lateness:\n%s", words().c_str());
    unexplained = unexplained || !late;
  }
  // A person does what the skip asks for, until this stone is thrown: lays it, and arms; and again when it was given
  // up.
  void throw_stone(int team) {
    const std::string turn = "of team" + std::to_string(team) + ": lay it";
    const auto asked_for = [&] {
      const auto turns = skip_told(Stamp{}, "turn");
      return !turns.empty() && turns.back().what.find(turn) != std::string::npos;
    };
    ASSERT_TRUE(wait_until(asked_for, patience)) << words();
    for (const Stamp begin = now(); now() - begin < stone_limit;) {
      const Stamp attempt = now();
      scene.hand().end();
      ASSERT_TRUE(scene.put_back("again " + std::to_string(team))) << words();
      scene.hand().start();
      const auto given_up = [&] {
        const auto end = scene.thrower().told_since(attempt, "disarmed");
        return end && end->what.find("the stone was let go") == std::string::npos;
      };
      const auto ends = [&] {
        return scene.skip().told_since(attempt, "thrown") || scene.skip().told_since(attempt, "game stopped");
      };
      ASSERT_TRUE(wait_until([&] { return ends() || given_up(); }, stone_limit)) << words();
      if (scene.skip().told_since(attempt, "thrown")) return;
      note_given_up(attempt);
      if (!wait_until([&] { return scene.skip().told_since(attempt, "game stopped").has_value(); }, 500ms)) continue;
      ASSERT_LT(records.size(), static_cast<std::size_t>(sittings)) << words();
      play();
    }
    FAIL() << words();
  }
  // But that a game which is gone on with does not begin at its beginning.
  void expect_clients_find_nothing_wrong() {
    for (const char* client : {"strategist", "second-strategist"}) {
      std::ifstream file(scene.folder() / (std::string(client) + ".jsonl"));
      for (std::string line; std::getline(file, line);) {
        if (records.size() > 1 && line == R"({"problem": "the first update"})") continue;
        EXPECT_THAT(line, Not(HasSubstr("problem"))) << client;
      }
    }
  }
  // What is told to the clients is what lies there in truth; stones that are out of play are not told of.
  void expect_board_is_true(const json& board, std::size_t thrown) {
    ASSERT_TRUE(wait_until([&] { return scene.truth(), scene.rests().size() >= thrown; }, patience)) << words();
    const auto& truth = scene.rests().back();
    for (const json& stone : board) {
      const double x_m = -stone.at("x_m").get<double>(), y_m = tee_y_m - stone.at("y_m").get<double>();
      const auto off_m = [&](const TrueStone& t) { return std::hypot(t.x_m - x_m, t.y_m - y_m); };
      const auto near = std::ranges::min_element(truth, {}, off_m);
      ASSERT_NE(near, truth.end());
      EXPECT_LT(off_m(*near), 0.15) << stone;
      EXPECT_EQ(near->team, stone.at("team") == "team0" ? 0 : 1) << stone;
    }
    const auto in_play = [](const TrueStone& t) { return t.y_m < 6.1 && t.y_m > -1.8 && std::abs(t.x_m) < 2.1; };
    EXPECT_GE(static_cast<long>(board.size()), std::ranges::count_if(truth, in_play)) << board << words();
  }
};

double missed_by_m(const json& record, const char* team) {
  for (const json& stone : record.at("board")) {
    if (stone.at("team") != team) continue;
    const json& wanted = record.at("intended");
    return std::hypot(stone.at("x_m").get<double>() - wanted.at("x_m").get<double>(),
                      stone.at("y_m").get<double>() - wanted.at("y_m").get<double>());
  }
  return INFINITY;
}

TEST_F(LiveGame, goes_on_from_stone_to_stone_and_after_it_was_stopped) {
  ASSERT_TRUE(scene.set_up()) << words();
  play();
  const Stamp begin = now();
  for (const int team : {0, 1}) {
    throw_stone(team);
    if (HasFatalFailure()) return;
    const auto record = throws_in(records.back());
    ASSERT_FALSE(record.empty()) << words();
    const double missed_m = missed_by_m(record.back(), team == 0 ? "team0" : "team1");
    std::printf("missed by %.2f m: %s\n", missed_m, record.back().dump().c_str());
    EXPECT_EQ(record.back().at("outcome"), "thrown");
    EXPECT_EQ(record.back().at("shot"), team);
    expect_board_is_true(record.back().at("board"), static_cast<std::size_t>(team) + 1);
  }
  EXPECT_FALSE(unexplained) << words();

  const auto ice = skip_told(begin, "ice");
  for (const Told& t : ice) std::printf("%s\n", t.what.c_str());
  ASSERT_EQ(ice.size(), 2U) << words();
  EXPECT_THAT(ice[0].what, HasSubstr("learnt from 1 stones"));
  EXPECT_THAT(ice[1].what, HasSubstr("learnt from 2 stones")) << words();

  // Stopped while the third stone is to be laid: it stands where it stood, and both clients hear of it anew.
  const Stamp third = now();
  scene.skip().say("stop");
  ASSERT_TRUE(wait_until([&] { return scene.skip().told_since(third, "game stopped").has_value(); }, patience))
      << words();
  EXPECT_EQ(scene.skip().told_since(third, "game stopped")->what, "as its operator said");
  const Stamp again = now();
  play();
  EXPECT_THAT(scene.skip().told_since(again, "asked")->what, HasSubstr("after end 0, shot 3 of 16"));
  EXPECT_NE(records.back(), records.front()) << "what was written before is kept";
  ASSERT_TRUE(wait_until([&] { return scene.skip().told_since(again, "turn").has_value(); }, patience)) << words();
  EXPECT_THAT(scene.skip().told_since(again, "turn")->what, HasSubstr("stone 2 of team0"));
  expect_clients_find_nothing_wrong();
}

}  // namespace
}  // namespace hogline::live_test
