#include "hw/socketcan/replay_bus.hpp"

#include <gtest/gtest.h>

#include <sstream>

using namespace hogline;
using namespace hogline::hw;
using namespace std::chrono_literals;

namespace {

std::vector<CandumpRecord> log_of(const std::string& text) {
  std::istringstream lines(text);
  CandumpLog log = read_candump_log(lines);
  EXPECT_TRUE(log.refused.empty());
  return log.records;
}

std::vector<CanFrame> read_all(CanBus& bus) {
  std::vector<CanFrame> frames;
  while (auto received = bus.receive()) frames.push_back(received->frame);
  return frames;
}

TEST(ReplayBus, GivesEachFrameAsLongAfterTheStartAsItWasRecorded) {
  SteppedClock clock(Stamp{} + 10s);
  ReplayBus bus(log_of("(100.000000) can0 181#01\n(100.005000) can0 182#02\n(100.005000) can0 183#03\n"), clock,
                clock.now());
  auto first = bus.receive();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->stamp, Stamp{} + 10s);
  clock.advance(4999us);
  EXPECT_FALSE(bus.receive());
  clock.advance(1us);
  EXPECT_EQ(read_all(bus),
            (std::vector<CanFrame>{{.id = 0x182, .length = 1, .data = {2}}, {.id = 0x183, .length = 1, .data = {3}}}));
  EXPECT_TRUE(bus.ended());
}

TEST(ReplayBus, OurOwnFramesAreKeptApart) {
  SteppedClock clock;
  const auto log = log_of("(1.000000) can0 601#40 T\n(1.000100) can0 581#43 R\n(1.000200) can0 201#00\n");
  ReplayBus bus(log, clock, clock.now(), {CanFilter{0x201}});
  clock.advance(1s);
  EXPECT_EQ(read_all(bus), (std::vector<CanFrame>{{.id = 0x581, .length = 1, .data = {0x43}}}));
  ASSERT_EQ(bus.transmitted().size(), 2U);
  EXPECT_EQ(bus.transmitted()[1].frame.id, 0x201U);
  EXPECT_EQ(bus.transmitted()[1].stamp, Stamp{} + 200us);

  EXPECT_EQ(bus.send({.id = 0x601}), CanSendResult::sent);
  ASSERT_EQ(bus.sent().size(), 1U);
  EXPECT_EQ(bus.sent()[0].stamp, Stamp{} + 1s);
  EXPECT_FALSE(bus.receive()) << "what is sent into a replay goes nowhere";
}

TEST(ReplayBus, IsDownFromARecordedBusOffToTheRestart) {
  SteppedClock clock;
  ReplayBus bus(log_of("(5.000000) can0 080#\n(5.010000) can0 20000040#0000000000000000\n"
                       "(5.020000) can0 20000004#0008000000000000\n(5.030000) can0 20000100#0000000000000000\n"),
                clock, clock.now());
  EXPECT_TRUE(bus.up());
  clock.advance(10ms);
  EXPECT_FALSE(bus.up()) << "by the clock, before anything was read";
  EXPECT_EQ(bus.send({.id = 0x201}), CanSendResult::bus_down);
  EXPECT_TRUE(bus.sent().empty());
  clock.advance(20ms);
  EXPECT_TRUE(bus.up());
  EXPECT_EQ(read_all(bus).size(), 1U) << "error frames are not data";
}

TEST(ReplayBus, ALogWhoseTimesGoBackIsPlayedInItsOrder) {
  SteppedClock clock;
  ReplayBus bus(log_of("(9.000000) can0 001#\n(9.010000) can0 002#\n(3.000000) can0 003#\n(9.020000) can0 004#\n"),
                clock, clock.now());
  clock.advance(10ms);
  EXPECT_EQ(read_all(bus).size(), 3U);
  clock.advance(10ms);
  EXPECT_EQ(read_all(bus), (std::vector<CanFrame>{{.id = 4}}));
}

TEST(ReplayBus, AnEmptyLogIsASilentBus) {
  SteppedClock clock;
  ReplayBus bus({}, clock, clock.now());
  EXPECT_TRUE(bus.up());
  EXPECT_TRUE(bus.ended());
  EXPECT_FALSE(bus.receive());
}

}  // namespace
