// Another vendor's DDS on our link, by ROS 2's names: it reads our topics and sends an order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include "hw/clock.hpp"
#include "hw/link/dds_team_link.hpp"
#include "tests/hil/process.hpp"
#include "tests/hw/link/example_messages.hpp"

namespace hogline::hw::link {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

Stamp now() { return SteadyClock{}.now(); }

bool eventually(const std::function<bool()>& holds, Duration limit = 30s) {
  for (const Stamp end = now() + limit; now() < end; std::this_thread::sleep_for(5ms))
    if (holds()) return true;
  return holds();
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(FastDds, reads_our_topics_by_their_ros_names_and_its_order_reaches_the_thrower) {
  const std::uint32_t domain = 1 + static_cast<std::uint32_t>(getpid()) % 200;
  const std::filesystem::path heard = std::filesystem::temp_directory_path() / ("fast_dds." + std::to_string(getpid()));
  LinkConfig config;
  config.robot = "thrower";
  config.domain = domain;
  DdsTeamLink thrower(config, now(), TeamTime{std::chrono::system_clock::now().time_since_epoch()});
  const hil::Process machine({HOGLINE_FAST_DDS_PROGRAM, std::to_string(domain), "77", "3"}, heard);

  std::optional<ShotOrderMessage> order;
  EXPECT_TRUE(eventually([&] {
    thrower.send(test::thrower_state(), now());
    thrower.send(test::board(), now());
    thrower.send(test::release(), now());
    while (const auto message = thrower.receive(now()))
      if (const auto* shot = std::get_if<ShotOrderMessage>(&message->message)) order = *shot;
    const std::string said = text_of(heard);
    return order && said.find("board") != std::string::npos && said.find("release") != std::string::npos;
  })) << text_of(heard);
  EXPECT_THAT(text_of(heard), HasSubstr("thrower " + std::to_string(thrower.state().session) + " 2"));
  EXPECT_THAT(text_of(heard), HasSubstr("board 1 2 0.100 -1.200 first"));
  EXPECT_THAT(text_of(heard), HasSubstr("release 2.0900"));
  std::filesystem::remove(heard);
  ASSERT_TRUE(order);
  EXPECT_EQ(order->origin.robot, "skip");
  EXPECT_EQ(order->origin.session, 77U);
  EXPECT_EQ(order->origin.serial, 3U);
  EXPECT_EQ(order->thrower_session, thrower.state().session);
  EXPECT_EQ(order->shot, 5U);
  EXPECT_EQ(order->speed_mps, 2.125);
  EXPECT_EQ(order->heading_rad, -0.0125);
  EXPECT_EQ(order->spin_radps, 1.5);
}

}  // namespace
}  // namespace hogline::hw::link
