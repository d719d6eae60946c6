// What is heard on the bus without sending.
#include "src/doctor/bus_ear.hpp"

#include <gtest/gtest.h>

namespace hogline::doctor {
namespace {

using namespace std::chrono_literals;

hw::StampedCanFrame at(Duration t, std::uint32_t id, std::uint8_t length = 0, std::uint8_t first = 0,
                       bool extended = false) {
  hw::CanFrame frame;
  frame.id = id;
  frame.extended = extended;
  frame.length = length;
  frame.data[0] = first;
  return {frame, Stamp{t}};
}

TEST(BusEar, measures_heartbeats) {
  BusEar ear({1, 2}, 127);
  for (int k = 0; k < 5; ++k) ear.on_frame(at(1s + k * Duration(50ms), 0x701, 1, 0x05));
  ear.on_frame(at(1s, 0x702, 1, 0x04));
  EXPECT_EQ(ear.node(1).heartbeats, 5);
  EXPECT_DOUBLE_EQ(*ear.node(1).period_s(), 0.05);
  EXPECT_EQ(ear.node(1).state, hw::NmtState::operational);
  EXPECT_EQ(ear.node(2).state, hw::NmtState::stopped);
  EXPECT_FALSE(ear.node(2).period_s());
  EXPECT_EQ(ear.node(3).heartbeats, 0);
  EXPECT_EQ(ear.other_master(), 0U);
}

TEST(BusEar, knows_what_only_a_master_sends) {
  struct Case {
    const char* description;
    hw::StampedCanFrame frame;
    bool masters;
  };
  for (const Case& c :
       {Case{"NMT", at(1s, 0x000, 2, 0x01), true}, Case{"SYNC", at(1s, 0x080), true},
        Case{"RPDO of ours", at(1s, 0x201, 6), true}, Case{"RPDO4 of ours", at(1s, 0x502, 6), true},
        Case{"our heartbeat", at(1s, 0x77F, 1, 0x05), true}, Case{"RPDO of a stranger", at(1s, 0x203, 6), false},
        Case{"TPDO of ours", at(1s, 0x181, 7), false}, Case{"EMCY of ours", at(1s, 0x081, 8), false},
        Case{"SDO answer", at(1s, 0x581, 8), false}, Case{"29 bits", at(1s, 0x000, 2, 0x01, true), false}}) {
    BusEar ear({1, 2}, 127);
    ear.on_frame(c.frame);
    EXPECT_EQ(ear.other_master() > 0, c.masters) << c.description;
  }
}

}  // namespace
}  // namespace hogline::doctor
