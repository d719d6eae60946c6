// Whole games with foreign Digital Curling clients over the kernel's loopback, on FCV1 itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "hw/digital_curling/digital_curling_strategist.hpp"
#include "src/game/built_in_strategist.hpp"
#include "tests/hw/eventually.hpp"
#include "tests/hw/peer.hpp"
#include "tests/src/game/ice_table.hpp"

namespace hogline::game::test {
namespace {

using testing::HasSubstr;

std::unique_ptr<hw::DigitalCurlingStrategist> server(Team team, const servo::GameSetting& setting) {
  hw::DigitalCurlingConfig config;
  config.session.team = team;
  config.session.identity = {"6f2f6f8e-0000-4000-8000-000000000001", "2026-11-22T10:05:00+00:00"};
  config.session.offer = {setting, {{{3.9, 0.0, 0.0}, {3.9, 0.0, 0.0}}}};
  return std::make_unique<hw::DigitalCurlingStrategist>(config);
}

std::unique_ptr<hw::Peer> client(const hw::DigitalCurlingStrategist& to, const std::string& name,
                                 const std::string& misbehaviour = "") {
  std::vector<std::string> words{"python3", HOGLINE_SOURCE_DIR "/tests/peers/digital_curling_client.py",
                                 std::to_string(to.port()), name};
  if (!misbehaviour.empty()) words.push_back(misbehaviour);
  return std::make_unique<hw::Peer>(words);
}

/// The client's last words; anything it finds wrong on the way is a failure.
nlohmann::json last_words(hw::Peer& peer) {
  for (;;) {
    const auto line = nlohmann::json::parse(peer.hear());
    EXPECT_FALSE(line.contains("problem")) << line;
    if (line.contains("end")) return line;
  }
}

/// Time is stepped, a millisecond for each look.
bool ends(Referee& referee) {
  Stamp now{std::chrono::hours(1)};
  return hw::comes_true(
      [&] {
        referee.step(now += 1ms);
        return referee.phase() == RefereePhase::over || referee.phase() == RefereePhase::stopped;
      },
      100s);
}

TEST(ForeignGame, TwoClientsPlayTwoEndsAndFindNothingWrong) {
  const servo::GameSetting setting = setting_of(2);
  auto first = server(Team::first, setting), second = server(Team::second, setting);
  const auto one = client(*first, "one"), two = client(*second, "two");
  SimulatedThrows throws = exact_throws();
  Witness witness;
  Referee referee(setting, {first.get(), second.get()}, throws, witness);
  ASSERT_TRUE(ends(referee));
  ASSERT_EQ(referee.phase(), RefereePhase::over) << referee.reason();
  const std::array<std::string, 2> names{"one", "two"};
  EXPECT_EQ(witness.names, names);

  int thrown = 0;
  for (const ThrowReport& report : witness.reports) thrown += report.end == ThrowEnd::thrown ? 1 : 0;
  EXPECT_EQ(static_cast<int>(witness.reports.size()) % 16, 0);
  EXPECT_GE(witness.reports.size(), 32u);
  for (const ThrowReport& report : witness.reports)
    if (report.end != ThrowEnd::thrown) std::printf("given away: %s\n", report.reason.c_str());
  EXPECT_GE(thrown, static_cast<int>(witness.reports.size()) - 3) << "shots that have no way on this ice are rare";

  for (auto* peer : {one.get(), two.get()}) {
    const auto end = last_words(*peer);
    EXPECT_EQ(end["end"], "game over");
    EXPECT_TRUE(end["problems"].empty()) << end["problems"];
    std::array<int, 2> counted{};
    for (const auto& points : end["scores"])
      for (const std::size_t side : {0u, 1u}) counted[side] += points[side].get<int>();
    EXPECT_EQ(counted[0], total(referee.state(), Team::first));
    EXPECT_EQ(counted[1], total(referee.state(), Team::second));
  }
}

TEST(ForeignGame, AClientThatVanishesStopsTheGame) {
  const servo::GameSetting setting = setting_of(2);
  auto first = server(Team::first, setting);
  const auto one = client(*first, "one", "vanish");
  SimulatedThrows throws = exact_throws();
  BuiltInStrategist second(Team::second, robot(), [&] { return throws.ice(); });
  Witness witness;
  Referee referee(setting, {first.get(), &second}, throws, witness);
  ASSERT_TRUE(ends(referee));
  EXPECT_EQ(referee.phase(), RefereePhase::stopped);
  EXPECT_THAT(referee.reason(), HasSubstr("team0's strategist \"one\""));
  EXPECT_THAT(referee.reason(), HasSubstr("vanished"));
  EXPECT_TRUE(witness.reports.empty());
}

TEST(ForeignGame, AClientPlaysAgainstTheBuiltInStrategist) {
  const servo::GameSetting setting = setting_of(1);
  auto second = server(Team::second, setting);
  SimulatedThrows throws = exact_throws();
  const auto two = client(*second, "two");
  BuiltInStrategist first(Team::first, robot(), [&] { return throws.ice(); });
  Witness witness;
  Referee referee(setting, {&first, second.get()}, throws, witness);
  ASSERT_TRUE(ends(referee));
  ASSERT_EQ(referee.phase(), RefereePhase::over) << referee.reason();
  EXPECT_TRUE(last_words(*two)["problems"].empty());
}

}  // namespace
}  // namespace hogline::game::test
