// What is neither sent nor accepted.
#include "hw/link/message_bounds.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "hw/link/wire_messages.hpp"
#include "tests/hw/link/example_messages.hpp"

namespace hogline::hw::link {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(MessageBounds, one_of_each_kind_is_fine) {
  for (const TeamMessage& message : test::one_of_each()) EXPECT_TRUE(within_bounds(message)) << message.index();
}

TEST(MessageBounds, refuses) {
  const struct {
    const char* what;
    TeamMessage message;
  } cases[] = {
      {"an order of no speed", test::with(test::order(), [](auto& m) { m.speed_mps = nan; })},
      {"an order of endless spin", test::with(test::order(), [](auto& m) { m.spin_radps = infinite; })},
      {"nobody's message", test::with(test::order(), [](auto& m) { m.origin.robot.clear(); })},
      {"a name without end", test::with(test::order(), [](auto& m) { m.origin.robot = std::string(65, 'a'); })},
      {"a name with a zero byte", test::with(test::order(), [](auto& m) { m.origin.robot = std::string("a\0b", 3); })},
      {"a time before 1970", test::with(test::order(), [](auto& m) { m.origin.stamp = TeamTime{Duration{-1}}; })},
      {"a reason without end", test::with(test::thrower_state(), [](auto& m) { m.reason = std::string(1025, 'a'); })},
      {"a release at no place", test::with(test::release(), [](auto& m) { m.hog_distance_m = nan; })},
      {"a stone of a third team", test::with(test::board(), [](auto& m) { m.stones[0].team = "third"; })},
      {"a stone nowhere", test::with(test::board(), [](auto& m) { m.stones[0].y_m = nan; })},
      {"stones without number", test::with(test::board(), [](auto& m) { m.stones.resize(65, m.stones[0]); })},
      {"a track with no covariance", test::with(test::track(), [](auto& m) { m.place_covariance_m2[1] = nan; })},
      {"a fate that is none", test::with(test::outcome(), [](auto& m) { m.fate = "burned?"; })},
      {"an outcome that is ok without a fate", test::with(test::outcome(), [](auto& m) { m.fate.clear(); })},
      {"a time that runs backwards", test::with(test::outcome(), [](auto& m) { m.hog_to_hog_s = -2.0; })},
      {"echoes without number", test::with(test::heartbeat(), [](auto& m) { m.echoes.resize(17, m.echoes[0]); })},
  };
  for (const auto& c : cases) {
    EXPECT_FALSE(within_bounds(c.message)) << c.what;
    EXPECT_FALSE(with_wire(c.message, [&](const void*) { ADD_FAILURE() << c.what << " was written"; })) << c.what;
  }
}

TEST(WireMessages, what_came_in_broken_is_no_message) {
  hogline_msgs_msg_dds__ThrowerState_ wire{};
  EXPECT_FALSE(plain(wire)) << "null texts";
  char name[] = "thrower";
  char nothing[] = "";
  wire.origin = {.robot = name, .session = 1, .serial = 1};
  wire.reason = nothing;
  EXPECT_TRUE(plain(wire));
  wire.phase = 6;
  EXPECT_FALSE(plain(wire)) << "a phase that is none";
  wire.phase = 5;
  wire.header.stamp.nanosec = 1'000'000'000;
  EXPECT_FALSE(plain(wire)) << "a second of too many nanoseconds";
  wire.header.stamp = {.sec = -1, .nanosec = 0};
  EXPECT_FALSE(plain(wire)) << "before 1970";
  wire.header.stamp = {};
  wire.origin.serial = 0;
  EXPECT_FALSE(plain(wire)) << "serial 0";
}

}  // namespace
}  // namespace hogline::hw::link
