// Which orders a thrower takes: as a sheet of requirements.
#include "hw/link/order_gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace hogline::hw::link {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr std::uint64_t ours = 700;    // the thrower's session
constexpr std::uint64_t theirs = 500;  // the skip's
const Stamp start{1000s};

OrderGateConfig config() {
  return {.commander = "skip", .session = ours, .longest_age = 500ms, .commander_gone = 800ms};
}

Origin from(const std::string& robot, std::uint64_t session, std::uint64_t serial) {
  return {.robot = robot, .session = session, .serial = serial, .stamp = {}};
}

ShotOrderMessage order(std::uint64_t serial, std::uint64_t session = theirs) {
  return {.origin = from("skip", session, serial),
          .thrower_session = ours,
          .shot = 1,
          .speed_mps = 2.0,
          .heading_rad = 0.0,
          .spin_radps = 1.5};
}

// A gate that hears the skip.
struct Gate : OrderGate {
  Gate() : OrderGate(config()) { heard(from("skip", theirs, 1), start); }
};

TEST(OrderGate, takes_each_order_once_in_its_order) {
  Gate gate;
  EXPECT_TRUE(gate.judge(order(1), start, start).accepted);
  EXPECT_TRUE(gate.judge(order(2), start, start).accepted);
  EXPECT_TRUE(gate.judge(order(7), start, start).accepted) << "serials in between were for nobody";
}

TEST(OrderGate, refuses_what_could_move_a_robot_wrongly) {
  ShotOrderMessage stranger = order(4);
  stranger.origin.robot = "coach";
  ShotOrderMessage yesterday = order(4);
  yesterday.thrower_session = ours - 1;
  const struct {
    const char* what;
    ShotOrderMessage order;
    std::optional<Stamp> sent;
    const char* says;
  } cases[] = {
      {"replayed", order(3), start, "came before"},
      {"overtaken by a later one", order(2), start, "older than order 3"},
      {"from somebody else", stranger, start, "only 'skip' commands"},
      {"of an earlier start of the skip", order(9, theirs - 1), start, "earlier start"},
      {"of a second skip", order(9, theirs + 1), start, "second 'skip'"},
      {"recorded for another start of the thrower", yesterday, start, "another start of this thrower"},
      {"too old", order(4), start - 501ms, "0.5 s old"},
      {"from the future", order(4), start + 501ms, "a clock is wrong"},
      {"of unknown age", order(4), std::nullopt, "not known yet"},
  };
  for (const auto& c : cases) {
    Gate gate;
    ASSERT_TRUE(gate.judge(order(3), start, start).accepted);
    const OrderVerdict verdict = gate.judge(c.order, c.sent, start);
    EXPECT_FALSE(verdict.accepted) << c.what;
    EXPECT_THAT(verdict.reason, HasSubstr(c.says)) << c.what;
    EXPECT_TRUE(gate.judge(order(4), start, start).accepted) << "after one that was " << c.what;
  }
}

TEST(OrderGate, refuses_a_commander_that_was_never_heard_or_fell_silent) {
  OrderGate unheard(config());
  EXPECT_THAT(unheard.judge(order(1), start, start).reason, HasSubstr("not been heard"));
  Gate silent;
  EXPECT_THAT(silent.judge(order(1), start + 900ms, start + 900ms).reason, HasSubstr("silent for 0.9 s"));
}

TEST(OrderGate, believes_a_commander_that_was_started_anew_only_after_the_old_one_fell_silent) {
  Gate gate;
  gate.heard(from("skip", theirs + 1, 1), start + 100ms);
  EXPECT_FALSE(gate.judge(order(1, theirs + 1), start + 100ms, start + 100ms).accepted);
  gate.heard(from("skip", theirs + 1, 2), start + 900ms);
  EXPECT_TRUE(gate.judge(order(1, theirs + 1), start + 900ms, start + 900ms).accepted);
  EXPECT_THAT(gate.judge(order(2, theirs), start + 900ms, start + 900ms).reason, HasSubstr("earlier start"));
}

TEST(OrderGate, an_old_start_does_not_come_back_when_the_new_one_falls_silent) {
  Gate gate;
  gate.heard(from("skip", theirs - 1, 99), start + 5s);
  EXPECT_FALSE(gate.judge(order(1, theirs - 1), start + 5s, start + 5s).accepted);
}

RC_GTEST_PROP(OrderGate, no_serial_is_ever_accepted_twice_nor_after_a_later_one, ()) {
  Gate gate;
  std::uint64_t last = 0;
  for (const auto serial : *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::inRange<std::uint64_t>(1, 30))) {
    const bool accepted = gate.judge(order(serial), start, start).accepted;
    RC_ASSERT(accepted == (serial > last));
    if (accepted) last = serial;
  }
}

}  // namespace
}  // namespace hogline::hw::link
