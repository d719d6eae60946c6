// The in-process bus: order, arbitration, time on the wire, faults by seed, candump text.
#include "hw/sim/virtual_can_bus.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hw/sim/candump.hpp"
#include "tests/hw/can_text.hpp"

namespace hogline::hw::test {
namespace {

using namespace std::chrono_literals;

std::vector<std::string> drain(CanBus& endpoint) {
  std::vector<std::string> frames;
  while (const auto received = endpoint.receive()) frames.push_back(text(received->frame));
  return frames;
}

TEST(VirtualCanBus, EverybodyElseReceives) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock);
  CanBus& a = bus.make_endpoint();
  CanBus& b = bus.make_endpoint();
  CanBus& c = bus.make_endpoint();
  EXPECT_EQ(a.send(frame("185#0102")), CanSendResult::sent);
  EXPECT_FALSE(b.receive()) << "not before deliver()";
  bus.deliver();
  EXPECT_EQ(drain(a), std::vector<std::string>{});
  EXPECT_EQ(drain(b), std::vector<std::string>{"185#0102"});
  EXPECT_EQ(drain(c), std::vector<std::string>{"185#0102"});
}

TEST(VirtualCanBus, TheLowestIdentifierWinsAndEachEndpointKeepsItsOrder) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock);
  CanBus& a = bus.make_endpoint();
  CanBus& b = bus.make_endpoint();
  CanBus& listener = bus.make_endpoint();
  a.send(frame("300#"));
  a.send(frame("080#"));
  b.send(frame("201#"));
  b.send(frame("301#"));
  bus.deliver();
  const std::vector<std::string> expected{"201#", "300#", "080#", "301#"};
  EXPECT_EQ(drain(listener), expected);
}

TEST(VirtualCanBus, ExtendedLosesAgainstTheSameBaseIdentifier) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock);
  CanBus& a = bus.make_endpoint();
  CanBus& b = bus.make_endpoint();
  CanBus& listener = bus.make_endpoint();
  a.send({.id = 0x100u << 18, .extended = true, .data = {}});
  b.send(frame("100#"));
  bus.deliver();
  EXPECT_FALSE(listener.receive()->frame.extended);
  EXPECT_TRUE(listener.receive()->frame.extended);
}

TEST(VirtualCanBus, FramesTakeTheirTimeOnTheWire) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock, {.bit_rate_hz = 1e6});
  CanBus& a = bus.make_endpoint();
  CanBus& b = bus.make_endpoint();
  for (int i = 0; i < 10; ++i) a.send(frame("185#0102030405060708"));
  bus.deliver();
  EXPECT_FALSE(b.receive()) << "no time has passed";
  clock.advance(1ms);
  bus.deliver();
  std::vector<Stamp> stamps;
  while (const auto received = b.receive()) stamps.push_back(received->stamp);
  ASSERT_EQ(stamps.size(), 8u);
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    EXPECT_GE(stamps[i] - stamps[i - 1], 111us);
    EXPECT_LE(stamps[i] - stamps[i - 1], 135us);
  }
  EXPECT_LE(stamps.back(), clock.now());
  clock.advance(1ms);
  bus.deliver();
  EXPECT_EQ(drain(b).size(), 2u);
}

TEST(VirtualCanBus, AFrameNeverArrivesBeforeItWasSent) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock, {.bit_rate_hz = 1e6});
  CanBus& a = bus.make_endpoint();
  CanBus& b = bus.make_endpoint();
  clock.advance(1s);
  a.send(frame("185#01"));
  bus.deliver();
  EXPECT_FALSE(b.receive());
  clock.advance(1ms);
  bus.deliver();
  EXPECT_GT(b.receive()->stamp, Stamp{1s});
}

TEST(VirtualCanBus, AFullQueueBlocksAndLosesNothingThatWasAccepted) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock, {.send_queue = 3});
  CanBus& a = bus.make_endpoint();
  CanBus& b = bus.make_endpoint();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(a.send(frame("185#01")), CanSendResult::sent);
  EXPECT_EQ(a.send(frame("185#02")), CanSendResult::would_block);
  bus.deliver();
  EXPECT_EQ(drain(b).size(), 3u);
  EXPECT_EQ(a.send(frame("185#03")), CanSendResult::sent);
}

TEST(VirtualCanBus, GoingDownLosesWhatWaited) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock);
  CanBus& a = bus.make_endpoint();
  CanBus& b = bus.make_endpoint();
  a.send(frame("185#01"));
  bus.set_up(false);
  EXPECT_FALSE(a.up());
  EXPECT_EQ(a.send(frame("185#02")), CanSendResult::bus_down);
  bus.set_up(true);
  bus.deliver();
  EXPECT_EQ(drain(b), std::vector<std::string>{});
}

TEST(VirtualCanBus, OneUnpluggedEndpointLeavesTheOthersAlone) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock);
  CanBus& a = bus.make_endpoint();
  CanBus& b = bus.make_endpoint();
  CanBus& c = bus.make_endpoint();
  bus.set_endpoint_up(b, false);
  a.send(frame("185#01"));
  bus.deliver();
  EXPECT_EQ(b.send(frame("186#01")), CanSendResult::bus_down);
  bus.set_endpoint_up(b, true);
  EXPECT_FALSE(b.receive());
  EXPECT_EQ(drain(c), std::vector<std::string>{"185#01"});
}

struct Tally {
  int received = 0;
  int changed = 0;
};

Tally tally(const sim::VirtualCanBusConfig& config) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock, config);
  CanBus& a = bus.make_endpoint();
  CanBus& b = bus.make_endpoint();
  Tally result;
  for (int i = 0; i < 10000; ++i) {
    a.send(frame("185#AABBCCDD"));
    bus.deliver();
    for (const std::string& seen : drain(b)) {
      ++result.received;
      result.changed += seen != "185#AABBCCDD" ? 1 : 0;
    }
  }
  return result;
}

TEST(VirtualCanBus, FaultsComeAsOftenAsAsked) {
  EXPECT_NEAR(tally({.loss = 0.1}).received, 9000, 150);
  EXPECT_NEAR(tally({.duplication = 0.1}).received, 11000, 150);
  EXPECT_NEAR(tally({.corruption = 0.1}).changed, 1000, 150);
  const Tally clean = tally({});
  EXPECT_EQ(clean.received, 10000);
  EXPECT_EQ(clean.changed, 0);
}

TEST(Candump, WritesTheLinesOfCandumpL) {
  const Stamp stamp{1795302065s + 451912us};
  EXPECT_EQ(sim::candump_line({frame("601#4041600000000000"), stamp}, "vcan0"),
            "(1795302065.451912) vcan0 601#4041600000000000");
  EXPECT_EQ(sim::candump_line({frame("080#"), Stamp{}}, "can1"), "(0000000000.000000) can1 080#");
  EXPECT_EQ(sim::candump_line({{.id = 0x1ABCDE, .extended = true, .length = 1, .data = {7}}, Stamp{1500us}}, "vcan0"),
            "(0000000000.001500) vcan0 001ABCDE#07");
  EXPECT_EQ(sim::candump_line({{.id = 0x705, .remote = true, .data = {}}, Stamp{}}, "vcan0"),
            "(0000000000.000000) vcan0 705#R");
}

}  // namespace
}  // namespace hogline::hw::test
