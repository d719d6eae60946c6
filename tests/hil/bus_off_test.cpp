// Bus-off, and what must not happen when the bus comes back.
#include <fcntl.h>
#include <linux/can/error.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/hil/can_node.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;

namespace {

constexpr CanFrame command(std::uint8_t number) { return {.id = 0x205, .length = 1, .data = {number}}; }

// Error frames as a driver makes them, from another program.
class ToldBusOff : public VcanTest {
 protected:
  void told(const std::string& error_frame) const { run("cansend " + name_ + " " + error_frame); }
  static constexpr auto bus_off = "20000040#0000000000000000";
  static constexpr auto restarted = "20000100#0000000000000000";
};

TEST_F(ToldBusOff, StopsEveryCommandUntilTheRestartAndFlushesNone) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  told(bus_off);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(bus.send(command(0x5A)), CanSendResult::bus_down);
  EXPECT_FALSE(bus.up());
  EXPECT_EQ(bus.state().phase, SocketCanPhase::bus_off);
  EXPECT_EQ(bus.state().controller, CanControllerState::bus_off);
  for (int i = 0; i < 20; ++i) period(bus);
  EXPECT_FALSE(bus.up()) << "time alone does not bring it back";

  told(restarted);
  ASSERT_TRUE(run_until(bus, [&] { return bus.up(); }));
  EXPECT_EQ(bus.state().controller, CanControllerState::active);
  ASSERT_EQ(bus.send(command(0xFE)), CanSendResult::sent);
  std::vector<can_frame> commands;
  for (const can_frame& frame : node.hear(3))  // bus-off, restarted and the command
    if (!(frame.can_id & CAN_ERR_FLAG)) commands.push_back(frame);
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].data[0], 0xFE);
  EXPECT_EQ(bus.state().counters.refused, 100U);
  EXPECT_EQ(bus.state().counters.bus_offs, 1U);
}

TEST_F(ToldBusOff, AsShortAsOneControlPeriodIsStillSeen) {
  SocketCanBus bus = running_bus();
  told(bus_off);
  told(restarted);
  period(bus);
  EXPECT_FALSE(bus.up());
  EXPECT_TRUE(run_until(bus, [&] { return bus.up(); }));
  EXPECT_EQ(bus.state().counters.outages, 1U);
}

TEST_F(ToldBusOff, ErrorPassiveIsToldWithItsCountersAndTheBusStaysUp) {
  SocketCanBus bus = running_bus();
  told("20000204#0020000000008005");
  period(bus);
  EXPECT_TRUE(bus.up());
  EXPECT_EQ(bus.state().controller, CanControllerState::passive);
  EXPECT_TRUE(bus.error_passive());
  EXPECT_EQ(bus.state().error_counters.transmit, 128);
  EXPECT_EQ(bus.state().error_counters.receive, 5);
  told("20000204#0040000000000000");
  period(bus);
  EXPECT_EQ(bus.state().controller, CanControllerState::active);
}

TEST_F(ToldBusOff, AFloodOfErrorFramesDoesNotHoldAPeriodUp) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  for (int i = 0; i < 3000; ++i) node.send(CAN_ERR_FLAG | CAN_ERR_BUSERROR, std::vector<unsigned char>(8));
  period(bus);
  EXPECT_LE(bus.state().counters.error_frames, 256U);
  EXPECT_TRUE(bus.up());
}

// A serial CAN adapter (slcan): the test is its hardware, at the other end of a pseudo terminal.
class SerialAdapter : public testing::Test {
 protected:
  void SetUp() override {
    hardware_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    ASSERT_GE(hardware_, 0);
    ASSERT_EQ(grantpt(hardware_), 0);
    ASSERT_EQ(unlockpt(hardware_), 0);
    port_ = open(ptsname(hardware_), O_RDWR | O_NOCTTY);
    ASSERT_GE(port_, 0);
    termios raw{};
    tcgetattr(port_, &raw);
    cfmakeraw(&raw);
    tcsetattr(port_, TCSANOW, &raw);
    const int slcan_discipline = 17;
    ASSERT_EQ(ioctl(port_, TIOCSETD, &slcan_discipline), 0) << "is the module slcan loaded?";
    char name[IFNAMSIZ] = {};
    ASSERT_EQ(ioctl(port_, SIOCGIFNAME, name), 0);
    name_ = name;
    run("ip link set " + name_ + " up");
  }

  void TearDown() override {
    close(port_);
    close(hardware_);
  }

  void says(const std::string& text) const {
    ASSERT_EQ(write(hardware_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }

  // What the adapter was told to send since the last call; does not wait.
  std::string heard() const {
    std::string text(4096, '\0');
    const ssize_t size = read(hardware_, text.data(), text.size());
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }

  int hardware_ = -1;
  int port_ = -1;
  std::string name_;
};

TEST_F(SerialAdapter, CommandsDuringAGenuineBusOffNeverReachTheWire) {
  SocketCanBus bus({.interface = name_}, now());
  ASSERT_TRUE(run_until(bus, [&] { return bus.up(); }));
  std::string wire;
  const auto on_the_wire = [&](const std::string& text) {
    wire += heard();
    return wire.find(text) != std::string::npos;
  };
  ASSERT_EQ(bus.send(command(0x11)), CanSendResult::sent);
  ASSERT_TRUE(run_until(bus, [&] { return on_the_wire("t205111\r"); })) << wire;
  says("t18520A0B\r");
  EXPECT_EQ(receive(bus, 1).size(), 1U);

  // A real race: commands go on while the controller drops off the bus.
  says("sb000000\r");
  ASSERT_TRUE(run_until(bus, [&] { return bus.send(command(0x5A)) == CanSendResult::bus_down; }));
  EXPECT_EQ(bus.state().phase, SocketCanPhase::bus_off);
  EXPECT_EQ(bus.state().counters.bus_offs, 1U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(bus.send(command(0x5B)), CanSendResult::bus_down);

  // What was sent before the bus-off may still be on its way to the adapter: until nothing more comes.
  for (int quiet = 0; quiet < 100; quiet = heard().empty() ? quiet + 1 : 0)
    period(bus), wait_until([] { return false; }, 1ms);
  wire.clear();
  run("ip link set " + name_ + " down && ip link set " + name_ + " up");
  ASSERT_TRUE(run_until(bus, [&] { return bus.up(); }));
  ASSERT_EQ(bus.send(command(0xFE)), CanSendResult::sent);
  ASSERT_TRUE(run_until(bus, [&] { return on_the_wire("t2051FE\r"); }));
  EXPECT_EQ(wire.find("t20515A"), std::string::npos) << "sent before the bus-off was known: " << wire;
  EXPECT_EQ(wire.find("t20515B"), std::string::npos) << "sent during the bus-off: " << wire;
}

TEST_F(SerialAdapter, ErrorStatesOfTheControllerAreFollowed) {
  SocketCanBus bus({.interface = name_}, now());
  ASSERT_TRUE(run_until(bus, [&] { return bus.up(); }));
  says("sw100005\r");
  EXPECT_TRUE(run_until(bus, [&] { return bus.state().controller == CanControllerState::warning; }));
  EXPECT_EQ(bus.state().error_counters.receive + bus.state().error_counters.transmit, 105);
  says("sp128000\r");
  EXPECT_TRUE(run_until(bus, [&] { return bus.state().controller == CanControllerState::passive; }));
  EXPECT_TRUE(bus.up());
  says("sa000000\r");
  EXPECT_TRUE(run_until(bus, [&] { return bus.state().controller == CanControllerState::active; }));
}

TEST_F(SerialAdapter, APulledPlugEndsTheInterface) {
  SocketCanBus bus({.interface = name_}, now());
  ASSERT_TRUE(run_until(bus, [&] { return bus.up(); }));
  close(hardware_);
  hardware_ = -1;
  EXPECT_TRUE(run_until(bus, [&] { return bus.state().phase == SocketCanPhase::no_interface; }));
  EXPECT_EQ(bus.send(command(1)), CanSendResult::bus_down);
}

}  // namespace
