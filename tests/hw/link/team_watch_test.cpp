// Who is there, who fell silent, who came back.
#include "hw/link/team_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hogline::hw::link {
namespace {

using namespace std::chrono_literals;

const Stamp start{1000s};
constexpr std::uint64_t ours = 5;

HeartbeatMessage beat(std::uint64_t serial, std::uint64_t session = 9, const std::string& robot = "skip") {
  return {.origin = {.robot = robot, .session = session, .serial = serial, .stamp = TeamTime{50s + serial * 1s}},
          .echoes = {}};
}

struct Watch : TeamWatch {
  Watch() : TeamWatch({.self = "thrower", .peers = {"skip"}, .silent_after = 300ms}) {}
  void hear(const HeartbeatMessage& heartbeat, Duration after) {
    heard(heartbeat, start + after, TeamTime{100s + after}, ours);
  }
  PeerState skip(Duration after) const { return peer("skip", start + after); }
};

TEST(TeamWatch, a_peer_is_unheard_then_there_then_silent_then_there_again) {
  Watch watch;
  EXPECT_EQ(watch.skip(0ms).presence, Presence::unheard);
  EXPECT_EQ(watch.missing(start), "skip: not heard yet");
  watch.hear(beat(1), 0ms);
  EXPECT_EQ(watch.skip(300ms).presence, Presence::there);
  EXPECT_EQ(watch.missing(start + 300ms), "");
  EXPECT_EQ(watch.skip(301ms).presence, Presence::silent);
  EXPECT_EQ(watch.missing(start + 400ms), "skip: silent for 0.4 s");
  watch.hear(beat(2), 500ms);
  EXPECT_EQ(watch.skip(500ms).presence, Presence::there);
  EXPECT_EQ(watch.skip(500ms).restarts, 0);
}

TEST(TeamWatch, replayed_and_reordered_heartbeats_keep_nobody_alive) {
  Watch watch;
  watch.hear(beat(8), 0ms);
  watch.hear(beat(8), 200ms);
  watch.hear(beat(3), 250ms);
  watch.hear(beat(100, 8), 280ms);  // of an earlier start
  EXPECT_EQ(watch.skip(400ms).presence, Presence::silent);
}

TEST(TeamWatch, a_new_start_is_counted_and_its_clock_is_measured_anew) {
  Watch watch;
  HeartbeatMessage with_echo = beat(1);
  with_echo.echoes = {{.robot = "thrower", .session = ours, .sent = TeamTime{99s}, .heard = TeamTime{51s}}};
  watch.hear(with_echo, 0ms);
  EXPECT_TRUE(watch.skip(0ms).clock);
  watch.hear(beat(1, 10), 301ms);
  EXPECT_EQ(watch.skip(301ms).restarts, 1);
  EXPECT_EQ(watch.skip(301ms).session, 10U);
  EXPECT_FALSE(watch.skip(301ms).clock);
}

// A second of the name must not keep the first alive, nor take its clock's place.
TEST(TeamWatch, a_second_start_is_not_believed_while_the_first_is_there) {
  Watch watch;
  HeartbeatMessage first = beat(1);
  first.echoes = {{.robot = "thrower", .session = ours, .sent = TeamTime{99s}, .heard = TeamTime{51s}}};
  watch.hear(first, 0ms);
  watch.hear(beat(1, 10), 150ms);
  watch.hear(beat(2, 10), 300ms);
  EXPECT_EQ(watch.rivals(), 2);
  EXPECT_EQ(watch.skip(300ms).session, 9U);
  EXPECT_TRUE(watch.skip(300ms).clock);
  EXPECT_EQ(watch.echoes()[0].session, 9U) << "the second is not answered";
  EXPECT_EQ(watch.skip(301ms).presence, Presence::silent);
  watch.hear(beat(3, 10), 350ms);
  EXPECT_EQ(watch.skip(350ms).session, 10U) << "the first is gone";
}

TEST(TeamWatch, lost_heartbeats_are_counted) {
  Watch watch;
  watch.hear(beat(4), 0ms);
  watch.hear(beat(9), 100ms);
  EXPECT_EQ(watch.skip(100ms).missed, 4);
}

TEST(TeamWatch, strangers_are_counted_and_echoes_for_others_are_none_of_ours) {
  Watch watch;
  watch.hear(beat(1, 9, "coach"), 0ms);
  EXPECT_EQ(watch.strangers(), 1);
  HeartbeatMessage for_others = beat(1);
  for_others.echoes = {{.robot = "coach", .session = ours, .sent = TeamTime{99s}, .heard = TeamTime{51s}},
                       {.robot = "thrower", .session = ours - 1, .sent = TeamTime{99s}, .heard = TeamTime{51s}}};
  watch.hear(for_others, 0ms);
  EXPECT_FALSE(watch.skip(0ms).clock);
}

TEST(TeamWatch, what_it_heard_goes_back_as_an_echo) {
  Watch watch;
  EXPECT_TRUE(watch.echoes().empty());
  watch.hear(beat(3), 250ms);
  ASSERT_EQ(watch.echoes().size(), 1U);
  const Echo echo = watch.echoes()[0];
  EXPECT_EQ(echo.robot, "skip");
  EXPECT_EQ(echo.session, 9U);
  EXPECT_EQ(echo.sent, TeamTime{53s});
  EXPECT_EQ(echo.heard, TeamTime{100s + 250ms});
}

}  // namespace
}  // namespace hogline::hw::link
