// An undisturbed bus: what is sent and received, filtered, confirmed, counted and stamped.
#include <sys/time.h>

#include <algorithm>

#include "tests/hil/can_node.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;

namespace {

class Traffic : public VcanTest {};

TEST_F(Traffic, BytesGoOutAndComeInAsTheyAre) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);

  const CanFrame command{.id = 0x605, .length = 8, .data = {0x40, 0x18, 0x10, 0x01, 1, 2, 3, 4}};
  const CanFrame extended{.id = 0x18FF0001, .extended = true, .length = 1, .data = {0xA5}};
  const CanFrame remote{.id = 0x705, .remote = true};
  for (const CanFrame& frame : {command, extended, remote}) ASSERT_EQ(bus.send(frame), CanSendResult::sent);
  const auto heard = node.hear(3);
  ASSERT_EQ(heard.size(), 3U);
  EXPECT_EQ(heard[0].can_id, 0x605U);
  EXPECT_TRUE(std::equal(command.data.begin(), command.data.end(), heard[0].data));
  EXPECT_EQ(heard[1].can_id, 0x18FF0001U | CAN_EFF_FLAG);
  EXPECT_EQ(heard[1].can_dlc, 1);
  EXPECT_EQ(heard[2].can_id, 0x705U | CAN_RTR_FLAG);

  node.send(0x585, {0x43, 0x18, 0x10, 0x01, 9, 8, 7, 6});
  node.send(0x18FF0002U | CAN_EFF_FLAG, {});
  node.send(0x701U | CAN_RTR_FLAG, {});
  const auto received = receive(bus, 3);
  ASSERT_EQ(received.size(), 3U) << "and none of our own";
  EXPECT_EQ(received[0].frame, (CanFrame{.id = 0x585, .length = 8, .data = {0x43, 0x18, 0x10, 0x01, 9, 8, 7, 6}}));
  EXPECT_EQ(received[1].frame, (CanFrame{.id = 0x18FF0002, .extended = true}));
  EXPECT_EQ(received[2].frame, (CanFrame{.id = 0x701, .remote = true}));
}

TEST_F(Traffic, EverySentFrameIsConfirmedByTheKernel) {
  SocketCanBus bus = running_bus();
  for (int i = 0; i < 50; ++i) {
    ASSERT_EQ(bus.send({.id = 0x80}), CanSendResult::sent);
    ASSERT_TRUE(period(bus).empty()) << "a confirmation is not a received frame";
  }
  EXPECT_TRUE(run_until(bus, [&] { return bus.state().counters.confirmed == 50; }));
  EXPECT_EQ(bus.state().counters.unconfirmed, 0U);
  EXPECT_FALSE(bus.state().unconfirmed_since);
}

TEST_F(Traffic, FiltersLetOnlyTheirOwnKindPass) {
  SocketCanBus bus = running_bus({.receive = {{0x185}, {0x585}}});
  CanNode node(name_);
  node.send(0x186, {1});
  node.send(0x185U | CAN_EFF_FLAG, {2});
  node.send(0x185U | CAN_RTR_FLAG, {});
  node.send_fd(0x185, {3});
  node.send(0x585, {4});
  node.send(0x185, {5});
  const auto received = receive(bus, 2);
  ASSERT_EQ(received.size(), 2U) << "extended, remote and FD frames with the same number do not pass";
  EXPECT_EQ(received[0].frame, (CanFrame{.id = 0x585, .length = 1, .data = {4}}));
  EXPECT_EQ(received[1].frame, (CanFrame{.id = 0x185, .length = 1, .data = {5}}));
}

TEST_F(Traffic, ASecondMasterIsCounted) {
  SocketCanBus bus = running_bus({.receive = {{0x185}}, .own = {{0x205}}, .confirm_deadline = generous});
  ASSERT_EQ(bus.send({.id = 0x205, .length = 2, .data = {0x0F, 0x00}}), CanSendResult::sent);
  EXPECT_TRUE(run_until(bus, [&] { return bus.state().counters.confirmed == 1; })) << "confirmed through `own`";
  EXPECT_EQ(bus.state().counters.foreign, 0U);

  CanNode other_master(name_);
  other_master.send(0x205, {0x0F, 0x00});
  const auto received = receive(bus, 1);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].frame.id, 0x205U);
  EXPECT_EQ(bus.state().counters.foreign, 1U);
}

TEST_F(Traffic, FramesThatWereNotReadInTimeAreCounted) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  constexpr unsigned flood = 5000;  // several times the socket's buffer
  for (unsigned i = 0; i < flood; ++i) node.send(0x185, {1});
  auto kept = receive(bus, flood, Duration::zero()).size();
  node.send(0x186, {});  // the kernel tells the number with the next frame
  kept += receive(bus, 1).size() - 1;
  EXPECT_GT(bus.state().counters.kernel_drops, 0U);
  EXPECT_EQ(kept + bus.state().counters.kernel_drops, flood);
}

TEST_F(Traffic, StampsAreOfTheArrivalAndNotOfTheReading) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  const Stamp before = now();
  node.send(0x185);
  const Stamp after = now();
  wait_until([&] { return now() > after + 100ms; });
  const auto received = receive(bus, 1);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_GE(received[0].stamp, before - 1ms);
  EXPECT_LE(received[0].stamp, after + 50ms) << "half of the way to the reading";
  EXPECT_EQ(bus.state().counters.stamps_replaced, 0U);
}

TEST_F(Traffic, AWallClockSetByAnHourDoesNotReachTheStamps) {
  SocketCanBus bus = running_bus();
  CanNode node(name_);
  for (const int step_s : {3600, -3600}) {
    node.send(0x185);
    timeval wall{};
    gettimeofday(&wall, nullptr);
    wall.tv_sec += step_s;
    ASSERT_EQ(settimeofday(&wall, nullptr), 0);
    const Stamp before = now();
    const auto received = receive(bus, 1);
    ASSERT_EQ(received.size(), 1U);
    EXPECT_GE(received[0].stamp, before);
    EXPECT_LE(received[0].stamp, now());
  }
  EXPECT_EQ(bus.state().counters.stamps_replaced, 2U);
}

}  // namespace
