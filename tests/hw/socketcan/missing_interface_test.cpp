// Runs on any host, with or without CAN in its kernel: the interface does not exist.
#include <gtest/gtest.h>

#include "hw/socketcan/socket_can_bus.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace std::chrono_literals;

namespace {

TEST(MissingInterface, IsAStateAndNotAnException) {
  const Stamp start{};
  SocketCanBus bus({.interface = "hoglinenone"}, start);
  for (Stamp now = start; now < start + 1s; now += 5ms) {
    bus.step(now);
    EXPECT_FALSE(bus.up());
    EXPECT_EQ(bus.send({.id = 0x201, .length = 8}), CanSendResult::bus_down);
    EXPECT_FALSE(bus.receive());
  }
  EXPECT_EQ(bus.state().phase, SocketCanPhase::no_interface);
  EXPECT_EQ(bus.state().counters.refused, 200U);
  EXPECT_EQ(bus.state().counters.sent, 0U);
  ASSERT_TRUE(bus.error());
  EXPECT_EQ(bus.error()->kind, DeviceErrorKind::disconnected);
  EXPECT_EQ(bus.error()->device, "hoglinenone");
}

}  // namespace
