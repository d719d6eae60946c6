// The adapter against a foreign client (tests/peers/digital_curling_client.py) over the kernel's loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "tests/hw/digital_curling/offer.hpp"
#include "tests/hw/eventually.hpp"
#include "tests/hw/peer.hpp"

namespace hogline::hw::digital_curling::test {
namespace {

using testing::HasSubstr;

/// One team's strategist and its client, up to where it is told of the game's first turn, which is the first team's.
/// Time is stepped: a millisecond for each look, and more where a test says so.
class Table {
 public:
  explicit Table(Team team, const std::string& misbehaviour)
      : strategist_(std::make_unique<DigitalCurlingStrategist>(DigitalCurlingConfig{.session = session_of(team)})),
        client_({"python3", HOGLINE_SOURCE_DIR "/tests/peers/digital_curling_client.py",
                 std::to_string(strategist_->port()), "foreign", misbehaviour}) {}

  /// A client that plays on learns that nobody else does, and ends.
  ~Table() { strategist_.reset(); }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  bool comes_to(StrategistPhase phase) {
    return comes_true([&] {
             now_ += 1ms;
             strategist_->step(now_);
             const StrategistPhase is = state().phase;
             return is == phase || is == StrategistPhase::failed;
           }) &&
           state().phase == phase;
  }
  void begin() {
    ASSERT_TRUE(comes_to(StrategistPhase::ready)) << state().reason;
    strategist_->begin({"foreign", "built-in"}, now_);
    strategist_->tell(first_update(session_of(Team::first)), now_);
  }
  void let_pass(Duration span) {
    now_ += span;
    strategist_->step(now_);
  }
  const StrategistState& state() const { return strategist_->state(); }
  Peer& client() { return client_; }
  std::string hear_of(const std::string& key) {
    for (;;) {
      const std::string line = client_.hear();
      EXPECT_EQ(line.find("\"problem\""), line.npos) << line;
      if (line.find("\"" + key + "\"") != line.npos) return line;
    }
  }

 private:
  std::unique_ptr<DigitalCurlingStrategist> strategist_;
  Stamp now_{std::chrono::hours(1)};
  Peer client_;
};

struct Misbehaviour {
  const char* name;
  Team team;
  const char* reason;
};

class Misbehaviours : public testing::TestWithParam<Misbehaviour> {};

TEST_P(Misbehaviours, EndInAClearMessageAndNoShot) {
  Table table(GetParam().team, GetParam().name);
  table.begin();
  EXPECT_TRUE(table.comes_to(StrategistPhase::failed));
  EXPECT_FALSE(table.state().decision);
  EXPECT_THAT(table.state().reason, HasSubstr("'s strategist \"foreign\" (127.0.0.1:"));
  EXPECT_THAT(table.state().reason, HasSubstr(GetParam().reason));
}

INSTANTIATE_TEST_SUITE_P(
    Each, Misbehaviours,
    testing::Values(Misbehaviour{"bad-json", Team::first, "sent what is not understood as move: it is no JSON"},
                    Misbehaviour{"wrong-cmd", Team::first, "cmd must be 'move' now, not 'ready_ok'"},
                    Misbehaviour{"vanish", Team::first, "vanished: "},
                    Misbehaviour{"huge-line", Team::first, "sent a line of more than 65536 bytes"},
                    Misbehaviour{"nan", Team::first, "it is no JSON"},
                    Misbehaviour{"infinite", Team::first, "number overflow parsing '1e999'"},
                    Misbehaviour{"rotation", Team::first, "move.rotation must be 'cw' or 'ccw', not 'left'"},
                    Misbehaviour{"out-of-turn", Team::second, "spoke when it was not its turn"},
                    Misbehaviour{"two-moves", Team::first, "spoke when it was not its turn"}),
    [](const auto& each) {
      std::string name = each.param.name;
      std::ranges::replace(name, '-', '_');
      return name;
    });

TEST(DigitalCurlingClient, WhoNeverConnectsIsNotWaitedForForEver) {
  Table table(Team::first, "never");
  table.let_pass(1ms);
  EXPECT_EQ(table.state().phase, StrategistPhase::preparing);
  table.let_pass(61s);
  EXPECT_EQ(table.state().phase, StrategistPhase::failed);
  EXPECT_THAT(table.state().reason, HasSubstr("did not connect within 60 s"));
}

TEST(DigitalCurlingClient, WhoNeverGreetsIsNotWaitedForForEver) {
  Table table(Team::first, "silent");
  table.let_pass(1ms);
  table.hear_of("done");
  table.let_pass(1ms);
  table.let_pass(11s);
  EXPECT_THAT(table.state().reason, HasSubstr("did not answer dc within 10 s"));
}

TEST(DigitalCurlingClient, ALateMoveIsNone) {
  Table table(Team::first, "late");
  table.begin();
  table.hear_of("waits");
  table.let_pass(599s);
  EXPECT_EQ(table.state().phase, StrategistPhase::thinking);
  table.let_pass(2s);
  EXPECT_EQ(table.state().phase, StrategistPhase::late);
  table.client().say("now");
  table.hear_of("done");
  table.let_pass(1s);
  EXPECT_EQ(table.state().phase, StrategistPhase::late);
  EXPECT_FALSE(table.state().decision);
  EXPECT_THAT(table.state().reason, HasSubstr("did not decide within its 600 s"));
}

TEST(DigitalCurlingClient, SlowBytesDoNotStopTheClock) {
  Table table(Team::first, "slow");
  table.begin();
  for (int i = 0; i < 10; ++i) {
    table.hear_of("sent");
    EXPECT_EQ(table.state().phase, StrategistPhase::thinking);
    table.let_pass(61s);
    table.client().say("on");
  }
  EXPECT_EQ(table.state().phase, StrategistPhase::late);
  EXPECT_FALSE(table.state().decision);
}

TEST(DigitalCurlingClient, ASecondClientIsTurnedAwayAndTheFirstPlaysOn) {
  Table table(Team::first, "twice");
  table.begin();
  EXPECT_TRUE(table.comes_to(StrategistPhase::decided)) << table.state().reason;
  EXPECT_EQ(table.hear_of("second_heard"), "{\"second_heard\": 0}");
  EXPECT_THAT(table.state().note, HasSubstr("a second client (127.0.0.1:"));
  EXPECT_THAT(table.state().note, HasSubstr("was turned away"));
}

TEST(DigitalCurlingClient, APortThatIsTakenOrNoAddressIsAnErrorAtTheStart) {
  DigitalCurlingStrategist first({.session = session_of(Team::first)});
  EXPECT_THROW(DigitalCurlingStrategist({.port = first.port(), .session = session_of(Team::second)}),
               std::system_error);
  EXPECT_THROW(DigitalCurlingStrategist({.address = "localhost!", .session = session_of(Team::first)}),
               std::invalid_argument);
}

}  // namespace
}  // namespace hogline::hw::digital_curling::test
