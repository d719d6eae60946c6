// Frames that are lost, late, doubled, damaged or stuck, by the kernel's own traffic control.
#include <algorithm>
#include <cstdio>
#include <map>

#include "tests/hil/can_node.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;

namespace {

class DisturbedBus : public VcanTest {
 protected:
  void disturb(const std::string& what) const { run("tc qdisc replace dev " + name_ + " root " + what); }
  void calm() const { run("tc qdisc del dev " + name_ + " root"); }
};

CanFrame numbered(std::uint8_t number) { return {.id = 0x205, .length = 1, .data = {number}}; }

TEST_F(DisturbedBus, LostFramesAreToldByTheirMissingConfirmation) {
  disturb("netem loss 30%");
  SocketCanBus bus = running_bus({.confirm_deadline = 1s});
  CanNode node(name_);
  std::size_t heard = 0;
  for (int batch = 0; batch < 2; ++batch) {
    for (int i = 0; i < 50; ++i) ASSERT_EQ(bus.send(numbered(1)), CanSendResult::sent);
    ASSERT_TRUE(run_until(bus, [&] { return !bus.state().unconfirmed_since; }));
    heard += node.hear_all().size();
  }
  const SocketCanCounters& counters = bus.state().counters;
  EXPECT_EQ(counters.confirmed + counters.unconfirmed, 100U);
  EXPECT_EQ(counters.confirmed, heard);
  EXPECT_GT(counters.unconfirmed, 5U);
  EXPECT_LT(counters.unconfirmed, 60U);
}

TEST_F(DisturbedBus, LateFramesComeWithTheirTimeOfArrival) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  disturb("netem delay 200ms");
  const Stamp sent = now();
  node.send(0x185, {1});
  const auto received = receive(bus, 1);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_GE(received[0].stamp, sent + 190ms);
}

TEST_F(DisturbedBus, DoubledFramesArriveTwiceAndAreConfirmedOnce) {
  disturb("netem duplicate 100%");
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  ASSERT_EQ(bus.send(numbered(7)), CanSendResult::sent);
  ASSERT_TRUE(run_until(bus, [&] { return bus.state().counters.confirmed == 1; }));
  node.send(0x185, {1});
  EXPECT_EQ(receive(bus, 2).size(), 2U);
  EXPECT_EQ(bus.state().counters.confirmed, 1U);
  EXPECT_EQ(bus.state().counters.foreign, 0U) << "our own frame twice is not a second master";
}

TEST_F(DisturbedBus, DamagedFramesAreStillFrames) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  disturb("netem corrupt 100%");
  for (int i = 0; i < 500; ++i) {
    node.send(0x185, {1, 2, 3, 4, 5, 6, 7, 8});
    for (const auto& received : period(bus)) {
      ASSERT_LE(received.frame.length, 8);
      ASSERT_LE(received.frame.id, received.frame.extended ? 0x1FFFFFFFU : 0x7FFU);
    }
  }
  calm();
  ASSERT_TRUE(run_until(bus, [&] { return bus.up(); })) << "a damaged identifier may read as a bus-off";
}

TEST_F(DisturbedBus, AFullBusSaysSoAfterAFewFramesAndForgetsTheRest) {
  disturb("tbf rate 8bit burst 72 limit 1mb");  // four frames at once, then one in 16 s: as if nobody acknowledged
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  std::uint8_t taken = 0;
  while (taken < 200 && bus.send(numbered(taken)) == CanSendResult::sent) ++taken;
  std::printf("frames on their way until the bus says that it is full: %d\n", taken);
  EXPECT_LE(taken, 16) << "three control periods of commands at most";
  for (int i = 0; i < 50; ++i) EXPECT_EQ(bus.send(numbered(250)), CanSendResult::would_block);
  EXPECT_EQ(bus.state().counters.would_block, 51U);

  calm();  // drops what the queue held
  ASSERT_TRUE(run_until(bus, [&] { return bus.send(numbered(251)) == CanSendResult::sent; }));
  const auto heard = node.hear(5);  // the four that had passed and the last
  EXPECT_EQ(heard.back().data[0], 251);
  EXPECT_TRUE(std::none_of(heard.begin(), heard.end(), [](const can_frame& f) { return f.data[0] == 250; }));
}

TEST_F(DisturbedBus, AQueueWithoutRoomIsToldAndNotAnError) {
  disturb("netem delay 60s limit 1");  // ENOBUFS from the second frame on
  SocketCanBus bus = running_bus();
  EXPECT_EQ(bus.send(numbered(1)), CanSendResult::sent);
  EXPECT_EQ(bus.send(numbered(2)), CanSendResult::would_block);
  EXPECT_TRUE(bus.up());
}

// How commands get stuck: the bus takes none (nobody acknowledges), and later all of them.
class StuckBus : public DisturbedBus {
 protected:
  // Lets four frames of 16 bytes pass, and then one in 16 s.
  void stick() const { disturb("tbf rate 8bit burst 72 limit 1mb"); }
  void come_loose() const { run("tc qdisc change dev " + name_ + " root tbf rate 10mbit burst 1mb limit 1mb"); }

  // Commands until the bus takes no more, then one with the number 99 after `meanwhile`: all that was heard from then
  // on.
  std::vector<int> heard_after(const std::function<void(SocketCanBus&)>& meanwhile) {
    stick();
    SocketCanBus bus = running_bus({.confirm_deadline = 60s});
    CanNode node(name_);
    for (std::uint8_t i = 1; bus.send(numbered(i)) == CanSendResult::sent;) ++i;
    EXPECT_EQ(node.hear(4).size(), 4U);
    meanwhile(bus);
    come_loose();
    node.send(0x7FF);  // the kernel looks at its queue when somebody sends
    EXPECT_TRUE(run_until(bus, [&] { return bus.send(numbered(99)) == CanSendResult::sent; }));
    std::vector<int> numbers;
    EXPECT_TRUE(wait_until([&] {
      for (const can_frame& frame : node.hear_all()) numbers.push_back(frame.data[0]);
      return !numbers.empty() && numbers.back() == 99;
    }));
    return numbers;
  }
};

TEST_F(StuckBus, CommandsInTheKernelDoNotSurviveALinkThatGoesDown) {
  const auto numbers = heard_after([&](SocketCanBus& bus) {
    run("ip link set " + name_ + " down");
    period(bus);
    EXPECT_FALSE(bus.up());
    EXPECT_GT(bus.state().counters.unconfirmed, 0U);
    run("ip link set " + name_ + " up");
    EXPECT_TRUE(run_until(bus, [&] { return bus.up(); }));
  });
  EXPECT_EQ(numbers, std::vector<int>{99});
}

// The limit of what a program can do: it can not take back what the kernel has accepted. doc/socketcan.md tells what
// bounds the harm. If this test fails because fewer come out, the limit has gone: say so there.
TEST_F(StuckBus, WithoutAnOutageAFewOldFramesComeOut) {
  const auto numbers = heard_after([](SocketCanBus& bus) { EXPECT_TRUE(bus.up()); });
  EXPECT_GT(numbers.size(), 1U);
  EXPECT_LE(numbers.size(), 1U + 8U);
}

// What the adapter does about it for set-points: the next is refused until the one before was seen on the bus.
TEST_F(StuckBus, OfEachSetPointOnlyOneOldFrameComesOut) {
  stick();
  SocketCanBus bus = running_bus({.one_at_a_time = {{0x201}, {0x202}, {0x080}}, .confirm_deadline = 60s});
  CanNode node(name_);
  std::vector<std::uint8_t> sent;           // numbers of the left wheel's set-points that the kernel took
  for (std::uint8_t i = 1; i <= 20; ++i) {  // as a control loop does until it notices
    wait_until([&] { return !period(bus).empty(); }, 5ms);
    if (bus.send({.id = 0x201, .length = 1, .data = {i}}) == CanSendResult::sent) sent.push_back(i);
    static_cast<void>(bus.send({.id = 0x202, .length = 1, .data = {i}}));
    static_cast<void>(bus.send({.id = 0x080}));
  }
  EXPECT_LE(sent.size(), 3U) << "two periods' frames pass, and one is stuck";
  const std::size_t passed = node.hear_all().size();

  come_loose();
  node.send(0x7FF);
  ASSERT_TRUE(run_until(bus, [&] { return !bus.state().unconfirmed_since; }));
  ASSERT_EQ(bus.send({.id = 0x201, .length = 1, .data = {99}}), CanSendResult::sent) << "and the way is free again";
  std::map<std::uint32_t, int> old_frames;
  ASSERT_TRUE(wait_until([&] {
    bool last = false;
    for (const can_frame& frame : node.hear_all()) {
      last = frame.can_dlc == 1 && frame.data[0] == 99;
      if (!last) ++old_frames[frame.can_id];
    }
    return last;
  }));
  std::printf("%zu frames had passed; then stuck: %d set-points, %d SYNC\n", passed,
              old_frames[0x201] + old_frames[0x202], old_frames[0x080]);
  EXPECT_LE(old_frames[0x201], 1);
  EXPECT_LE(old_frames[0x202], 1);
  EXPECT_GE(old_frames[0x201] + old_frames[0x202] + old_frames[0x080], 1) << "else nothing was stuck";
  EXPECT_LE(old_frames[0x080], 1);
}

}  // namespace
