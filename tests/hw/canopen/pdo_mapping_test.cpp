// The mapping sequence of CiA 301 and the wheel's PDOs.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "hw/canopen/drive_pdos.hpp"
#include "hw/canopen/pdo_mapping.hpp"
#include "tests/hw/can_text.hpp"

namespace hogline::hw::test {
namespace {

std::vector<std::string> frames(const std::vector<SdoWrite>& writes) {
  std::vector<std::string> result;
  for (const SdoWrite& write : writes) result.push_back(text(sdo_download_frame(5, write)));
  return result;
}

TEST(PdoMapping, AReceivePdoWithItsWatchdog) {
  const std::vector<std::string> expected{
      "605#2300140105020080",  // 1400:01 COB-ID 205, invalid
      "605#2F00160000000000",  // 1600:00 count 0
      "605#2300160110004060",  // 6040:00, 16 bits
      "605#230016022000FF60",  // 60FF:00, 32 bits
      "605#2F00160002000000",  // count 2
      "605#2F00140201000000",  // every SYNC
      "605#2B00140528000000",  // event timer 40 ms
      "605#2300140105020000",  // valid
  };
  EXPECT_EQ(frames(pdo_mapping_sequence(command_pdo_config(5, 40))), expected);
}

TEST(PdoMapping, ATransmitPdoForbidsRemoteRequests) {
  const std::vector<std::string> expected{
      "605#23011801850200C0",  // 1801:01 COB-ID 285, invalid, no RTR
      "605#2F011A0000000000",  // 1A01:00 count 0
      "605#23011A0120006460",  // 6064:00, 32 bits
      "605#23011A0210003F60",  // 603F:00, 16 bits
      "605#2F011A0002000000",  // count 2
      "605#2F01180201000000",  // every SYNC
      "605#2301180185020040",  // valid
  };
  EXPECT_EQ(frames(pdo_mapping_sequence(position_pdo_config(5))), expected);
}

TEST(PdoMapping, SwitchingOffIsOptional) {
  const SdoWrite write = pdo_disable(PdoDirection::receive, 3, 0x405);
  EXPECT_EQ(text(sdo_download_frame(5, write)), "605#2302140105040080");
  EXPECT_TRUE(write.optional);
}

TEST(WheelPdos, FitTheirFrames) {
  for (const PdoConfig& pdo : {command_pdo_config(5, 40), status_pdo_config(5), position_pdo_config(5)}) {
    int bits = 0;
    for (const MappedObject& object : pdo.objects) bits += object.bits;
    EXPECT_LE(bits, 64);
  }
}

TEST(WheelPdos, Golden) {
  EXPECT_EQ(text(encode(DriveCommandPdo{0x000F, -1000}, 5)), "205#0F0018FCFFFF");
  const auto status = decode_status(frame("185#270218FCFFFF09"));
  ASSERT_TRUE(status);
  EXPECT_EQ(decode_statusword(status->statusword), Cia402State::operation_enabled);
  EXPECT_EQ(status->velocity, -1000);
  EXPECT_EQ(status->mode, 9);
  const auto position = decode_position(frame("285#FFFFFFFF1023"));
  ASSERT_TRUE(position);
  EXPECT_EQ(position->position, -1);
  EXPECT_EQ(position->error_code, 0x2310);
}

TEST(WheelPdos, AnyOtherLengthIsNothing) {
  CanFrame any = frame("185#0000000000000000");
  for (std::uint8_t length = 0; length <= 8; ++length) {
    any.length = length;
    EXPECT_EQ(decode_status(any).has_value(), length == 7);
    EXPECT_EQ(decode_position(any).has_value(), length == 6);
  }
}

RC_GTEST_PROP(WheelPdos, TheTargetSurvivesTheFrame, (std::int32_t target)) {
  const CanFrame sent = encode(DriveCommandPdo{0x000F, target}, 5);
  std::uint32_t read = 0;
  for (std::size_t i = 4; i-- > 0;) read = (read << 8) | sent.data[2 + i];
  RC_ASSERT(static_cast<std::int32_t>(read) == target);
}

}  // namespace
}  // namespace hogline::hw::test
