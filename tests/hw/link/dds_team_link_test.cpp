// The link on the loopback interface: two robots in one process, each with a participant of its own.
#include "hw/link/dds_team_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "hw/clock.hpp"
#include "hw/link/wire_messages.hpp"
#include "tests/hw/link/example_messages.hpp"

namespace hogline::hw::link {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

const TeamTime utc{std::chrono::seconds{1'800'000'000}};

Stamp now() { return SteadyClock{}.now(); }

// Test programs run side by side on one machine.
LinkConfig config(const std::string& robot) {
  return {.robot = robot,
          .peers = {},
          .domain = 1 + static_cast<std::uint32_t>(getpid()) % 200,
          .interface = "lo",
          .addresses = {},
          .security = std::nullopt};
}

bool eventually(const std::function<bool()>& holds, Duration limit = 20s) {
  for (const Stamp end = now() + limit; now() < end; std::this_thread::sleep_for(1ms))
    if (holds()) return true;
  return holds();
}

struct TwoRobots : testing::Test {
  DdsTeamLink skip{config("skip"), now(), utc};
  DdsTeamLink thrower{config("thrower"), now(), utc + 3s};

  void SetUp() override {
    for (std::size_t kind = 0; kind < std::variant_size_v<TeamMessage>; ++kind) {
      ASSERT_TRUE(eventually([&] {
        return skip.matched_readers(kind) == 1 && thrower.matched_readers(kind) == 1 &&
               skip.matched_writers(kind) == 1 && thrower.matched_writers(kind) == 1;
      })) << "no match of kind "
          << kind;
    }
  }
  std::optional<ReceivedMessage> hear(DdsTeamLink& link) {
    std::optional<ReceivedMessage> heard;
    eventually([&] { return (heard = link.receive(now())).has_value(); });
    return heard;
  }
};

TEST_F(TwoRobots, each_kind_arrives_as_it_was_sent_with_its_origin) {
  for (const TeamMessage& sent : test::one_of_each()) {
    const Stamp at = now();
    ASSERT_EQ(skip.send(sent, at), TeamSendResult::sent);
    const auto heard = hear(thrower);
    ASSERT_TRUE(heard) << sent.index();
    const Origin& origin = origin_of(heard->message);
    EXPECT_EQ(origin.robot, "skip");
    EXPECT_EQ(origin.session, skip.state().session);
    EXPECT_EQ(origin.serial, 1U);
    EXPECT_EQ(origin.stamp, skip.team_time(at));
    TeamMessage expected = sent;
    std::visit([&](auto& m) { m.origin = origin; }, expected);
    EXPECT_TRUE(heard->message == expected) << sent.index();
  }
  EXPECT_EQ(thrower.state().malformed, 0);
}

TEST_F(TwoRobots, serials_grow_by_one_for_each_kind_by_itself) {
  skip.send(test::order(), now());
  skip.send(test::heartbeat(), now());
  skip.send(test::order(), now());
  std::vector<std::uint64_t> orders;
  eventually([&] {
    if (const auto heard = thrower.receive(now()); heard && std::holds_alternative<ShotOrderMessage>(heard->message))
      orders.push_back(origin_of(heard->message).serial);
    return orders.size() == 2;
  });
  EXPECT_EQ(orders, (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(TwoRobots, ones_own_messages_do_not_come_back) {
  skip.send(test::order(), now());
  ASSERT_TRUE(hear(thrower));
  EXPECT_FALSE(skip.receive(now()));
}

TEST_F(TwoRobots, what_can_not_be_said_is_refused_and_uses_up_no_serial) {
  ShotOrderMessage endless = test::order();
  endless.speed_mps = std::numeric_limits<double>::infinity();
  EXPECT_EQ(skip.send(endless, now()), TeamSendResult::refused);
  skip.send(test::order(), now());
  const auto heard = hear(thrower);
  ASSERT_TRUE(heard);
  EXPECT_EQ(origin_of(heard->message).serial, 1U);
}

TEST_F(TwoRobots, an_emergency_stop_overtakes_what_waits) {
  skip.send(test::order(), now());
  skip.send(test::emergency_stop(), now());
  constexpr std::size_t stops = std::variant_size_v<TeamMessage> - 1;
  // Both are there when the one that was sent later is: the order's topic is as reliable as the stop's.
  std::vector<std::size_t> kinds;
  ASSERT_TRUE(eventually([&] { return thrower.waiting(0) && thrower.waiting(stops); }));
  for (int i = 0; i < 2; ++i) kinds.push_back(thrower.receive(now())->message.index());
  EXPECT_EQ(kinds, (std::vector<std::size_t>{stops, 0}));
}

TEST_F(TwoRobots, who_comes_later_hears_the_emergency_stop_in_force_but_no_old_order) {
  skip.send(test::order(), now());
  skip.send(test::emergency_stop(), now());
  DdsTeamLink late(config("late"), now(), utc);
  const auto heard = hear(late);
  ASSERT_TRUE(heard);
  EXPECT_TRUE(std::holds_alternative<EmergencyStopMessage>(heard->message));
  EXPECT_FALSE(late.receive(now()));
}

TEST(DdsTeamLink, an_interface_that_is_not_there_is_named) {
  LinkConfig wrong = config("skip");
  wrong.domain += 1;
  wrong.interface = "wlan7";
  try {
    DdsTeamLink link(wrong, now(), utc);
    FAIL() << "opened";
  } catch (const LinkError& error) {
    EXPECT_THAT(error.what(), HasSubstr("wlan7"));
  }
}

TEST(DdsTeamLink, keys_that_are_not_there_are_named) {
  LinkConfig secure = config("skip");
  secure.security = LinkSecurity{.folder = "no/such/folder"};
  try {
    DdsTeamLink link(secure, now(), utc);
    FAIL() << "opened";
  } catch (const LinkError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no identity_ca.pem in no/such/folder"));
  }
}

TEST(LinkConfig, the_configuration_names_one_interface_and_no_multicast) {
  LinkConfig two = config("skip");
  two.interface = "eth0";
  two.addresses = {"10.0.0.2", "<evil>"};
  const std::string xml = cyclone_xml(two);
  EXPECT_THAT(xml, HasSubstr("name=\"eth0\" multicast=\"false\""));
  EXPECT_THAT(xml, HasSubstr("<AllowMulticast>false</AllowMulticast>"));
  EXPECT_THAT(xml, HasSubstr("<Peer Address=\"10.0.0.2\"/><Peer Address=\"&lt;evil&gt;\"/>"));
}

}  // namespace
}  // namespace hogline::hw::link
