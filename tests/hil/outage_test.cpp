// The interface goes down and up, disappears and comes back.
#include "tests/hil/can_node.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;

namespace {

class Outage : public VcanTest {
 protected:
  void unplug() const { run("ip link del " + name_); }
  void plug_in() const { run("ip link add " + name_ + " type vcan && ip link set " + name_ + " up"); }
  void link(const std::string& state) const { run("ip link set " + name_ + " " + state); }
};

constexpr CanFrame fresh{.id = 0x205, .length = 1, .data = {0xFE}};
constexpr CanFrame stale{.id = 0x205, .length = 1, .data = {0x5A}};

TEST_F(Outage, LinkDownRefusesCommandsAndTheSameBusGoesOnAfterUp) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  link("down");
  period(bus);
  EXPECT_FALSE(bus.up());
  EXPECT_EQ(bus.state().phase, SocketCanPhase::link_down);
  ASSERT_TRUE(bus.error());
  EXPECT_EQ(bus.error()->kind, DeviceErrorKind::disconnected);
  EXPECT_EQ(bus.send(stale), CanSendResult::bus_down);

  link("up");
  ASSERT_TRUE(run_until(bus, [&] { return bus.up(); }));
  EXPECT_FALSE(bus.error());
  EXPECT_EQ(bus.send(fresh), CanSendResult::sent);
  const auto heard = node.hear(1);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].data[0], 0xFE);
  EXPECT_EQ(bus.state().counters.outages, 1U);
  EXPECT_EQ(bus.state().counters.opened, 1U) << "the same socket";
}

TEST_F(Outage, ALinkThatWasDownBetweenTwoPeriodsIsSeenForOnePeriod) {
  SocketCanBus bus = running_bus();
  link("down");
  link("up");
  period(bus);
  EXPECT_FALSE(bus.up());
  EXPECT_TRUE(run_until(bus, [&] { return bus.up(); }));
  EXPECT_EQ(bus.state().counters.outages, 1U);
}

TEST_F(Outage, ASendThatFindsTheLinkDownSaysSo) {
  SocketCanBus bus = running_bus();
  link("down");
  EXPECT_EQ(bus.send(stale), CanSendResult::bus_down);
  EXPECT_FALSE(bus.up());
}

TEST_F(Outage, AnAdapterThatIsUnpluggedIsFoundAgainByItsName) {
  SocketCanBus bus = running_bus();
  unplug();
  period(bus);
  EXPECT_EQ(bus.state().phase, SocketCanPhase::no_interface);
  EXPECT_EQ(bus.send(stale), CanSendResult::bus_down);
  EXPECT_FALSE(bus.receive());

  plug_in();
  CanNode node(name_);
  ASSERT_TRUE(run_until(bus, [&] { return bus.up(); }));
  EXPECT_EQ(bus.state().counters.opened, 2U);
  EXPECT_EQ(bus.send(fresh), CanSendResult::sent);
  node.send(0x185, {1});
  EXPECT_EQ(receive(bus, 1).size(), 1U);
  EXPECT_EQ(node.hear(1).size(), 1U) << "only the fresh command";
}

TEST_F(Outage, AnAdapterThatWasReplacedBetweenTwoPeriodsIsOpenedAnew) {
  SocketCanBus bus = running_bus();
  unplug();
  plug_in();
  period(bus);
  EXPECT_FALSE(bus.up());
  ASSERT_TRUE(run_until(bus, [&] { return bus.up(); }));
  CanNode node(name_);
  EXPECT_EQ(bus.send(fresh), CanSendResult::sent);
  EXPECT_EQ(node.hear(1).size(), 1U);
}

TEST_F(Outage, TheInterfaceMayComeLaterThanTheProgram) {
  unplug();
  SocketCanBus bus({.interface = name_}, now());
  period(bus);
  EXPECT_EQ(bus.state().phase, SocketCanPhase::no_interface);
  run("ip link add " + name_ + " type vcan");
  ASSERT_TRUE(run_until(bus, [&] { return bus.state().phase == SocketCanPhase::link_down; }));
  EXPECT_EQ(bus.send(stale), CanSendResult::bus_down);
  link("up");
  EXPECT_TRUE(run_until(bus, [&] { return bus.up(); }));
}

TEST_F(Outage, AFlappingLinkIsCountedEachTime) {
  SocketCanBus bus = running_bus();
  for (unsigned i = 1; i <= 5; ++i) {
    link("down");
    period(bus);
    ASSERT_FALSE(bus.up());
    link("up");
    ASSERT_TRUE(run_until(bus, [&] { return bus.up(); }));
    ASSERT_EQ(bus.state().counters.outages, i);
  }
}

}  // namespace
