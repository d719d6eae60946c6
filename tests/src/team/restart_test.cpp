// Two ends of the link of which one is started anew: what is ordered is thrown once, or refused with a reason; nothing
// is lost because it came too early.
#include <gtest/gtest.h>

#include "hw/link/link_config.hpp"
#include "hw/link/local_team_link.hpp"
#include "hw/link/order_gate.hpp"
#include "src/skip/simulated_skip.hpp"
#include "src/skip/skip_oracle.hpp"
#include "src/team/skip_member.hpp"
#include "tests/src/team/practice_team.hpp"

namespace hogline::test {
namespace {

using namespace std::chrono_literals;

constexpr Duration period = 5ms;

/// The thrower's end: it judges what comes, as a thrower does.
struct Thrower {
  Thrower(hw::TeamLink& link)
      : end(link, "thrower", "skip"),
        gate({.commander = "skip",
              .session = link.state().session,
              .longest_age = 2s,
              .commander_gone = hw::link::heartbeat_deadline}) {}
  void step(Stamp now) {
    end.step(now);
    while (const auto received = end.receive(now)) {
      if (std::holds_alternative<hw::HeartbeatMessage>(received->message))
        gate.heard(hw::origin_of(received->message), now);
      if (const auto* order = std::get_if<hw::ShotOrderMessage>(&received->message))
        verdicts.push_back(gate.judge(*order, end.local(order->origin.stamp, now), now));
    }
  }
  LinkEnd end;
  hw::link::OrderGate gate;
  std::vector<hw::link::OrderVerdict> verdicts;
};

struct Restart : testing::Test {
  void pass(Duration span, const std::function<void()>& also = {}) {
    for (const Stamp end = clock.now() + span; clock.now() < end; clock.advance(period)) {
      if (thrower) thrower->step(clock.now());
      if (also) also();
    }
  }
  /// A skip that is heard, and then no more.
  void skip_was_here(Duration span) {
    LinkEnd before(team.join("skip"), "skip", "thrower");
    pass(span, [&] {
      before.step(clock.now());
      while (before.receive(clock.now())) {
      }
    });
    EXPECT_TRUE(before.answered(clock.now()));
  }

  hw::SteppedClock clock{Stamp{1000s}};
  hw::link::LocalTeam team{clock, 2ms};
  std::optional<Thrower> thrower{std::in_place, team.join("thrower")};
};

// The law: who sends at the first moment at which it is answered is taken for what it is.
TEST_F(Restart, an_order_at_the_first_moment_of_an_answer_is_taken) {
  for (const Duration away : {0ms, 30ms, 100ms, 295ms, 300ms, 350ms, 2000ms}) {
    skip_was_here(500ms);
    pass(away);
    hw::TeamLink& link = team.join("skip");
    LinkEnd skip(link, "skip", "thrower");
    thrower->verdicts.clear();
    const Stamp begin = clock.now();
    std::optional<Stamp> ordered;
    pass(1500ms, [&] {
      skip.step(clock.now());
      while (skip.receive(clock.now())) {
      }
      if (ordered || !skip.answered(clock.now())) return;
      ordered = clock.now();
      hw::ShotOrderMessage order;
      order.thrower_session = skip.peer_session(clock.now());
      skip.send(order, clock.now());
    });
    ASSERT_TRUE(ordered) << "away for " << seconds(away);
    EXPECT_GE(*ordered - begin + away, hw::link::heartbeat_deadline - hw::link::heartbeat_period);
    ASSERT_EQ(thrower->verdicts.size(), 1U);
    EXPECT_TRUE(thrower->verdicts[0].accepted) << thrower->verdicts[0].reason << ", away for " << seconds(away);
  }
}

TEST_F(Restart, a_thrower_that_was_started_anew_has_to_answer_anew) {
  hw::TeamLink& link = team.join("skip");
  LinkEnd skip(link, "skip", "thrower");
  const auto live = [&] {
    skip.step(clock.now());
    while (skip.receive(clock.now())) {
    }
  };
  pass(500ms, live);
  ASSERT_TRUE(skip.answered(clock.now()));
  const std::uint64_t session = skip.peer_session(clock.now());
  thrower.reset();
  pass(350ms, live);
  EXPECT_FALSE(skip.answered(clock.now())) << "it is silent";
  thrower.emplace(team.join("thrower"));
  bool early = false;
  pass(500ms, [&] {
    live();
    early = early || (skip.answered(clock.now()) && skip.peer_session(clock.now()) == session);
  });
  EXPECT_FALSE(early);
  EXPECT_TRUE(skip.answered(clock.now()));
}

/// The skip as one of the team, on the practice rink.
struct SkipOnTheRink {
  explicit SkipOnTheRink(hw::TeamLink& link)
      : request(practice_team(3)),
        robot(with_small_pictures(request.skip), request.scenario, 1),
        member(
            request.skip, robot.devices(),
            [this] {
              return std::make_unique<SkipOracle>(robot.rink(), robot.scenario(), request.skip, robot.axes(),
                                                  SkipOracleQuality{}, 1);
            },
            link) {}
  TeamRequest request;
  SimulatedSkip robot;
  SkipMember member;
};

TEST_F(Restart, the_skips_order_waits_for_the_thrower_to_answer_and_is_sent_once) {
  skip_was_here(500ms);
  SkipOnTheRink skip(team.join("skip"));
  const auto live = [&] { skip.member.step(clock.now(), period); };
  skip.member.begin(servo::IceModel({}).estimate(), clock.now());
  skip.member.order({.speed_mps = 2.1, .spin_radps = 1.5}, 1, Team::first, clock.now());
  EXPECT_EQ(skip.member.ordered(), OrderPhase::sent);
  pass(1200ms, live);
  ASSERT_EQ(thrower->verdicts.size(), 1U);
  EXPECT_TRUE(thrower->verdicts[0].accepted) << thrower->verdicts[0].reason;
  EXPECT_EQ(skip.member.ordered(), OrderPhase::sent);
}

TEST_F(Restart, the_skips_order_is_refused_when_nobody_answers) {
  thrower.reset();
  SkipOnTheRink skip(team.join("skip"));
  skip.member.begin(servo::IceModel({}).estimate(), clock.now());
  skip.member.order({.speed_mps = 2.1, .spin_radps = 1.5}, 1, Team::first, clock.now());
  pass(1600ms, [&] { skip.member.step(clock.now(), period); });
  EXPECT_EQ(skip.member.ordered(), OrderPhase::refused);
  EXPECT_EQ(skip.member.why(), "thrower: not heard yet");
  thrower.emplace(team.join("thrower"));
  pass(1000ms, [&] { skip.member.step(clock.now(), period); });
  EXPECT_TRUE(thrower->verdicts.empty()) << "an order that was refused is not sent later";
}

}  // namespace
}  // namespace hogline::test
