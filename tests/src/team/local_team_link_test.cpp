// The link within one process behaves as a link does.
#include "hw/link/local_team_link.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hogline::hw::link {
namespace {

using namespace std::chrono_literals;

struct Pair {
  SteppedClock clock{Stamp{} + 5s};
  LocalTeam team{clock, 2ms};
  TeamLink& thrower = team.join("thrower");
  TeamLink& skip = team.join("skip");
};

TEST(LocalTeamLink, AMessageArrivesOnceNumberedAndStampedAndLate) {
  Pair p;
  ShotOrderMessage order;
  order.origin.robot = "somebody else";
  order.speed_mps = 2.0;
  EXPECT_EQ(p.skip.send(order, p.clock.now()), TeamSendResult::sent);
  EXPECT_FALSE(p.thrower.receive(p.clock.now())) << "it is under way";
  p.clock.advance(2ms);
  const auto received = p.thrower.receive(p.clock.now());
  ASSERT_TRUE(received);
  const Origin& origin = origin_of(received->message);
  EXPECT_EQ(origin.robot, "skip");
  EXPECT_EQ(origin.serial, 1U);
  EXPECT_EQ(origin.session, p.skip.state().session);
  EXPECT_EQ(origin.stamp, p.skip.team_time(Stamp{} + 5s));
  EXPECT_FALSE(p.thrower.receive(p.clock.now()));
  EXPECT_FALSE(p.skip.receive(p.clock.now())) << "one's own do not come back";
}

TEST(LocalTeamLink, WhatNobodyWouldAcceptIsNotSent) {
  Pair p;
  ShotOrderMessage order;
  order.speed_mps = std::nan("");
  EXPECT_EQ(p.skip.send(order, p.clock.now()), TeamSendResult::refused);
  order.speed_mps = 2.0;
  EXPECT_EQ(p.skip.send(order, p.clock.now()), TeamSendResult::sent);
  p.clock.advance(1s);
  EXPECT_EQ(origin_of(p.thrower.receive(p.clock.now())->message).serial, 1U) << "the refused one has no number";
}

TEST(LocalTeamLink, ARobotThatJoinsAnewIsAnotherSession) {
  Pair p;
  const std::uint64_t before = p.skip.state().session;
  EXPECT_GT(p.team.join("skip").state().session, before);
}

}  // namespace
}  // namespace hogline::hw::link
