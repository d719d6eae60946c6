#include "hw/digital_curling/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "tests/hw/digital_curling/offer.hpp"

namespace hogline::hw::digital_curling::test {
namespace {

using testing::HasSubstr;

const Stamp start{std::chrono::hours(1)};
const std::string dc_ok = "{\"cmd\":\"dc_ok\",\"name\":\"ai\"}\n";
const std::string ready_ok = "{\"cmd\":\"ready_ok\",\"player_order\":[0,1,2,3]}\n";
const std::string move =
    "{\"cmd\":\"move\",\"move\":{\"type\":\"shot\",\"velocity\":{\"x\":0.1,\"y\":2.4},\"rotation\":\"cw\"}}\n";

struct Talk {
  explicit Talk(Team team = Team::first, SessionConfig given = session_of(Team::first))
      : config(std::move(given)), session(config, "here:1") {
    config.team = team;
    session = Session(config, "here:1");
    session.tick(start);
  }
  /// What the session said since it was asked last.
  std::string said() { return std::exchange(session.outgoing(), {}); }
  void until_ready() {
    session.connected(start);
    session.receive(dc_ok, start);
    session.receive(ready_ok, start);
    ASSERT_EQ(session.state().phase, StrategistPhase::ready) << session.state().reason;
  }
  void until_its_turn() {
    until_ready();
    session.begin({"ai", "other"}, start);
    session.tell(first_update(config), start);
    said();
  }
  SessionConfig config;
  Session session;
};

TEST(Session, GreetsOffersAndWaits) {
  Talk talk;
  EXPECT_EQ(talk.said(), "");
  talk.session.connected(start);
  EXPECT_THAT(talk.said(), HasSubstr("\"cmd\":\"dc\""));
  talk.session.receive(dc_ok, start);
  EXPECT_THAT(talk.said(), HasSubstr("\"cmd\":\"is_ready\""));
  EXPECT_EQ(talk.session.state().phase, StrategistPhase::preparing);
  talk.session.receive(ready_ok, start);
  EXPECT_EQ(talk.session.state().phase, StrategistPhase::ready);
  EXPECT_EQ(talk.session.state().name, "ai");
  EXPECT_EQ(talk.said(), "");
}

TEST(Session, AMoveInTimeIsADecisionWithItsTime) {
  Talk talk;
  talk.until_its_turn();
  EXPECT_EQ(talk.session.state().phase, StrategistPhase::thinking);
  talk.session.receive(move, start + 7s);
  ASSERT_EQ(talk.session.state().phase, StrategistPhase::decided);
  EXPECT_EQ(talk.session.state().decision->thought, Duration(7s));
  EXPECT_EQ(std::get<servo::HackShot>(talk.session.state().decision->move).vy_mps, 2.4);
}

TEST(Session, TimesAreSecondsAndResultsAreTold) {
  Talk talk;
  talk.until_its_turn();
  talk.session.receive(move, start + 1500ms);
  servo::GameUpdate update = first_update(talk.config);
  update.state = servo::conceded(servo::thought(update.state, 1500ms));
  update.last = servo::LastMove{servo::Concession{}, false, {}};
  talk.session.tell(update, start + 2s);
  const std::string said = talk.said();
  EXPECT_THAT(said, HasSubstr("\"thinking_time_remaining\":{\"team0\":598.5,\"team1\":600.0}"));
  EXPECT_THAT(said, HasSubstr("\"game_result\":{\"reason\":\"concede\",\"winner\":\"team1\"}"));
  EXPECT_THAT(said, HasSubstr("\"next_team\":null"));
  EXPECT_THAT(said, HasSubstr("\"last_move\":{\"actual_move\":{\"type\":\"concede\"},\"free_guard_zone_foul\":false}"));
  EXPECT_THAT(said, HasSubstr("{\"cmd\":\"game_over\"}\n"));
  EXPECT_EQ(talk.session.state().phase, StrategistPhase::over);
  talk.session.receive("good bye", start + 3s);
  talk.session.lost("hung up");
  EXPECT_EQ(talk.session.state().phase, StrategistPhase::over) << "after the end it may say and do what it likes";
}

TEST(Session, WhoDecidesTooLateHasNotDecided) {
  for (const Duration after : {Duration(600s), Duration(601s)}) {
    Talk talk;
    talk.until_its_turn();
    talk.session.receive(move, start + after);
    EXPECT_EQ(talk.session.state().phase, StrategistPhase::late);
    EXPECT_FALSE(talk.session.state().decision);
    EXPECT_EQ(talk.session.state().reason, "team0's strategist \"ai\" (here:1) did not decide within its 600 s");
  }
}

struct Breach {
  const char* what;
  std::string bytes;
  const char* reason;
};

class Breaches : public testing::TestWithParam<Breach> {};

TEST_P(Breaches, InItsTurnEndTheSessionWithoutADecision) {
  Talk talk;
  talk.until_its_turn();
  talk.session.receive(GetParam().bytes, start + 1s);
  EXPECT_EQ(talk.session.state().phase, StrategistPhase::failed);
  EXPECT_FALSE(talk.session.state().decision);
  EXPECT_EQ(talk.session.state().reason, std::string("team0's strategist \"ai\" (here:1) ") + GetParam().reason);
  talk.session.receive(move, start + 2s);
  EXPECT_FALSE(talk.session.state().decision) << "for good";
}

INSTANTIATE_TEST_SUITE_P(
    Each, Breaches,
    testing::Values(
        Breach{"two_moves", move + move, "spoke when it was not its turn"},
        Breach{"a_move_and_a_half", move + "{", "spoke when it was not its turn"},
        Breach{"an_empty_line", "\n",
               "sent what is not understood as move: it is no JSON: parse error at line 1, "
               "column 1: syntax error while parsing value - unexpected end of input; "
               "expected '[', '{', or a literal"},
        Breach{"a_long_line", std::string(65537, 'x'), "sent a line of more than 65536 bytes"},
        Breach{"a_long_line_with_its_end", std::string(65537, 'x') + "\n", "sent a line of more than 65536 bytes"},
        Breach{"ready_again", ready_ok, "sent what is not understood as move: cmd must be 'move' now, not 'ready_ok'"}),
    [](const auto& breach) { return std::string(breach.param.what); });

TEST(Session, SpeakingBeforeTheGameOrInTheOthersTurnFails) {
  Talk eager;
  eager.until_ready();
  eager.session.receive("{", start);
  EXPECT_THAT(eager.session.state().reason, HasSubstr("spoke when it was not its turn"));
  Talk other(Team::second);
  other.until_its_turn();
  EXPECT_EQ(other.session.state().phase, StrategistPhase::waiting);
  other.session.receive(move, start);
  EXPECT_THAT(other.session.state().reason,
              HasSubstr("team1's strategist \"ai\" (here:1) spoke when it was not its turn"));
}

TEST(Session, EveryWaitHasItsDeadline) {
  Talk nobody;
  nobody.session.tick(start + 61s);
  EXPECT_EQ(nobody.session.state().reason, "team0's strategist (here:1) did not connect within 60 s");
  Talk silent;
  silent.session.connected(start);
  silent.session.tick(start + 11s);
  EXPECT_EQ(silent.session.state().reason, "team0's strategist (here:1) did not answer dc within 10 s");
  Talk loading;
  loading.session.connected(start);
  loading.session.receive(dc_ok, start);
  loading.session.tick(start + 11s);
  EXPECT_EQ(loading.session.state().phase, StrategistPhase::preparing);
  loading.session.tick(start + 601s);
  EXPECT_EQ(loading.session.state().reason, "team0's strategist \"ai\" (here:1) was not ready within 600 s");
}

TEST(Session, AClientThatDoesNotReadFails) {
  SessionConfig config = session_of(Team::first);
  config.most_unread = 4000;
  Talk talk(Team::second, config);
  talk.until_ready();
  talk.session.begin({"a", "b"}, start);
  for (int i = 0; i < 20 && talk.session.state().phase != StrategistPhase::failed; ++i)
    talk.session.tell(first_update(talk.config), start);
  EXPECT_THAT(talk.session.state().reason, HasSubstr("does not read what it is sent"));
}

// However the bytes are cut, what they say is the same.
RC_GTEST_PROP(SessionProperty, PiecesOfALineAreALine, ()) {
  Talk talk;
  talk.until_its_turn();
  std::string rest = move;
  while (!rest.empty()) {
    const auto length = *rc::gen::inRange<std::size_t>(1, rest.size() + 1);
    talk.session.receive(rest.substr(0, length), start + 1s);
    rest.erase(0, length);
  }
  RC_ASSERT(talk.session.state().phase == StrategistPhase::decided);
}

}  // namespace
}  // namespace hogline::hw::digital_curling::test
