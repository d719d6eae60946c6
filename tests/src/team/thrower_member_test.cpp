// What a thrower takes from whom: stops that are called and taken back, orders of a stranger.
#include "src/team/thrower_member.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hw/link/local_team_link.hpp"
#include "src/throwing/simulated_throw.hpp"
#include "tests/src/team/practice_team.hpp"

namespace hogline::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

struct ThrowerOnTheRink : testing::Test {
  void pass(Duration span, LinkEnd* skip = nullptr) {
    for (const Stamp end = now() + span; now() < end;) {
      robot.rink().step(5ms);
      if (skip) {
        skip->step(now());
        hear(*skip);
      }
      member.step(now(), 5ms);
    }
  }
  Stamp now() const { return robot.rink().now(); }
  void hear(LinkEnd& skip) {
    while (const auto received = skip.receive(now()))
      if (const auto* state = std::get_if<hw::ThrowerStateMessage>(&received->message)) told = *state;
  }
  void stop(hw::TeamLink& from, bool pressed) {
    from.send(hw::EmergencyStopMessage{.origin = {}, .pressed = pressed, .reason = "a hand"}, now());
    pass(20ms);
  }

  TeamRequest request = practice_team(3);
  SimulatedRobot robot{with_small_pictures(request.thrower), request.scenario, 1};
  hw::link::LocalTeam team{robot.rink().clock(), 2ms};
  hw::TeamLink& link = team.join("thrower");
  ThrowerMember member{request.thrower, robot.devices(), [] { return nullptr; }, link};
  hw::ThrowerStateMessage told;
};

TEST_F(ThrowerOnTheRink, a_stop_is_taken_back_by_whoever_called_it_or_by_the_operator) {
  hw::TeamLink &coach = team.join("coach"), &skip = team.join("skip");
  stop(coach, true);
  stop(skip, true);
  stop(skip, false);
  EXPECT_THAT(member.not_ready(), HasSubstr("emergency stop by 'coach': a hand"));
  stop(coach, false);
  EXPECT_THAT(member.not_ready(), Not(HasSubstr("emergency stop")));
  stop(coach, true);
  member.load();
  EXPECT_THAT(member.not_ready(), Not(HasSubstr("emergency stop")));
}

// The commander waits for an answer to its own number.
TEST_F(ThrowerOnTheRink, a_strangers_order_is_refused_under_no_number_of_the_commanders) {
  hw::TeamLink &coach = team.join("coach"), &skip_link = team.join("skip");
  LinkEnd skip(skip_link, "skip", "thrower");
  pass(300ms, &skip);
  ASSERT_TRUE(skip.answered(now()));
  hw::ShotOrderMessage order;
  order.thrower_session = link.state().session;
  coach.send(order, now());
  pass(100ms, &skip);
  EXPECT_THAT(told.reason, HasSubstr("only 'skip' commands"));
  EXPECT_EQ(told.order_serial, 0U);
  EXPECT_EQ(told.phase, hw::ThrowerPhase::idle);
  skip.send(order, now());
  pass(100ms, &skip);
  EXPECT_EQ(told.order_serial, 1U);
  EXPECT_EQ(told.phase, hw::ThrowerPhase::stopped);
  const std::string why = told.reason;
  coach.send(order, now());
  pass(100ms, &skip);
  EXPECT_EQ(told.reason, why) << "the commander's answer stands";
  EXPECT_EQ(member.orders(), 3);
}

}  // namespace
}  // namespace hogline::test
