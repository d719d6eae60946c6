// NMT, heartbeat, SYNC and EMCY frames against CiA 301.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "hw/canopen/cob_id.hpp"
#include "hw/canopen/emergency.hpp"
#include "hw/canopen/little_endian.hpp"
#include "hw/canopen/nmt.hpp"
#include "tests/hw/can_text.hpp"

namespace hogline::hw::test {
namespace {

TEST(Nmt, CommandsAreTheStandards) {
  EXPECT_EQ(text(nmt_frame(NmtCommand::start, 5)), "000#0105");
  EXPECT_EQ(text(nmt_frame(NmtCommand::stop, 5)), "000#0205");
  EXPECT_EQ(text(nmt_frame(NmtCommand::enter_pre_operational, 5)), "000#8005");
  EXPECT_EQ(text(nmt_frame(NmtCommand::reset_node, 5)), "000#8105");
  EXPECT_EQ(text(nmt_frame(NmtCommand::reset_communication, 5)), "000#8205");
  EXPECT_EQ(text(sync_frame()), "080#");
  EXPECT_EQ(text(heartbeat_frame(127, NmtState::operational)), "77F#05");
}

TEST(CobId, ThePredefinedConnectionSet) {
  EXPECT_EQ(emergency_cob_id(5), 0x085u);
  EXPECT_EQ(tpdo_cob_id(1, 5), 0x185u);
  EXPECT_EQ(tpdo_cob_id(4, 5), 0x485u);
  EXPECT_EQ(rpdo_cob_id(1, 5), 0x205u);
  EXPECT_EQ(rpdo_cob_id(4, 5), 0x505u);
  EXPECT_EQ(sdo_response_cob_id(5), 0x585u);
  EXPECT_EQ(sdo_request_cob_id(5), 0x605u);
  EXPECT_EQ(heartbeat_cob_id(5), 0x705u);
}

struct HeartbeatRow {
  const char* frame;
  std::optional<NmtState> state;
};

TEST(Heartbeat, StateBytes) {
  const HeartbeatRow rows[] = {{"705#00", NmtState::boot_up},     {"705#04", NmtState::stopped},
                               {"705#05", NmtState::operational}, {"705#7F", NmtState::pre_operational},
                               {"705#85", NmtState::operational},  // bit 7 is reserved
                               {"705#42", NmtState::unknown},     {"705#", std::nullopt},
                               {"705#0500", std::nullopt},        {"700#05", std::nullopt},
                               {"605#05", std::nullopt}};
  for (const HeartbeatRow& row : rows) {
    const std::optional<Heartbeat> heartbeat = decode_heartbeat(frame(row.frame));
    ASSERT_EQ(heartbeat.has_value(), row.state.has_value()) << row.frame;
    if (!heartbeat) continue;
    EXPECT_EQ(heartbeat->node, 5) << row.frame;
    EXPECT_EQ(heartbeat->state, *row.state) << row.frame;
  }
}

TEST(Heartbeat, ExtendedAndRemoteFramesAreNone) {
  CanFrame extended = frame("705#05");
  extended.extended = true;
  EXPECT_FALSE(decode_heartbeat(extended));
  CanFrame remote = frame("705#05");
  remote.remote = true;
  EXPECT_FALSE(decode_heartbeat(remote));
}

RC_GTEST_PROP(Heartbeat, RoundTrip, ()) {
  const auto node = *rc::gen::inRange<std::uint8_t>(1, 128);
  const auto state =
      *rc::gen::element(NmtState::boot_up, NmtState::stopped, NmtState::operational, NmtState::pre_operational);
  const std::optional<Heartbeat> decoded = decode_heartbeat(heartbeat_frame(node, state));
  RC_ASSERT(decoded.has_value());
  RC_ASSERT(decoded->node == node);
  RC_ASSERT(decoded->state == state);
}

TEST(Emergency, Decodes) {
  const std::optional<Emergency> emergency = decode_emergency(frame("085#3081110102030405"));
  ASSERT_TRUE(emergency);
  EXPECT_EQ(emergency->node, 5);
  EXPECT_EQ(emergency->code, 0x8130);
  EXPECT_EQ(emergency->error_register, 0x11);
  EXPECT_EQ(emergency->manufacturer[4], 5);
  EXPECT_EQ(describe(*emergency), "EMCY 8130 (heartbeat of the master lost), register 11");
}

TEST(Emergency, SyncAndShortFramesAreNone) {
  EXPECT_FALSE(decode_emergency(frame("080#3081110102030405")));
  EXPECT_FALSE(decode_emergency(frame("085#30811101020304")));
  EXPECT_FALSE(decode_emergency(frame("105#3081110102030405")));
}

TEST(Emergency, Meanings) {
  EXPECT_STREQ(emergency_meaning(0x0000), "no error");
  EXPECT_STREQ(emergency_meaning(0x8250), "RPDO timeout");
  EXPECT_STREQ(emergency_meaning(0x8140), "recovered from bus-off");
  EXPECT_STREQ(emergency_meaning(0x3210), "voltage");
  EXPECT_STREQ(emergency_meaning(0x4310), "temperature");
  EXPECT_STREQ(emergency_meaning(0xA000), "manufacturer specific");
}

RC_GTEST_PROP(LittleEndian, RoundTrip, (std::int32_t value32, std::uint16_t value16, std::int8_t value8)) {
  std::array<std::uint8_t, 4> bytes{};
  put_le(bytes, value32);
  RC_ASSERT(get_le<std::int32_t>(bytes) == value32);
  put_le(bytes, value16);
  RC_ASSERT(get_le<std::uint16_t>(bytes) == value16);
  put_le(bytes, value8);
  RC_ASSERT(get_le<std::int8_t>(bytes) == value8);
}

}  // namespace
}  // namespace hogline::hw::test
