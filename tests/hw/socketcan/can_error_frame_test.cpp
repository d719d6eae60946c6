// Error frames as in linux/can/error.h; the numbers are written out, not taken from it.
#include "hw/socketcan/can_error_frame.hpp"

#include <gtest/gtest.h>

#include <string>

using namespace hogline::hw;

namespace {

using Bytes = std::array<std::uint8_t, 8>;

struct Case {
  std::string what;
  std::uint32_t id;
  Bytes data;
  std::optional<CanControllerState> state;
  bool restarted;
};

class EnteredState : public testing::TestWithParam<Case> {};

TEST_P(EnteredState, IsDecoded) {
  const CanErrorFrame decoded = decode_error_frame(GetParam().id, GetParam().data);
  EXPECT_EQ(decoded.state, GetParam().state);
  EXPECT_EQ(decoded.restarted, GetParam().restarted);
}

INSTANTIATE_TEST_SUITE_P(
    Table, EnteredState,
    testing::Values(Case{"bus_off", 0x20000040, {}, CanControllerState::bus_off, false},
                    Case{"bus_off_without_the_error_flag", 0x40, {}, CanControllerState::bus_off, false},
                    Case{"bus_off_wins_over_what_else_is_told", 0x44, {0, 0x30}, CanControllerState::bus_off, false},
                    Case{"restarted", 0x20000100, {}, CanControllerState::active, true},
                    Case{"receiver_passive", 0x20000004, {0, 0x10}, CanControllerState::passive, false},
                    Case{"transmitter_passive", 0x20000004, {0, 0x20}, CanControllerState::passive, false},
                    Case{"passive_and_warning", 0x20000004, {0, 0x28}, CanControllerState::passive, false},
                    Case{"receiver_warning", 0x20000004, {0, 0x04}, CanControllerState::warning, false},
                    Case{"transmitter_warning", 0x20000004, {0, 0x08}, CanControllerState::warning, false},
                    Case{"active_again", 0x20000004, {0, 0x40}, CanControllerState::active, false},
                    Case{"overflow_is_no_state", 0x20000004, {0, 0x01}, std::nullopt, false},
                    Case{"detail_without_its_class", 0x20000020, {0, 0x30}, std::nullopt, false},
                    Case{"nothing", 0x20000000, {}, std::nullopt, false}),
    [](const auto& one) { return one.param.what; });

TEST(ErrorFrame, FlagsAreDecodedOneByOne) {
  EXPECT_TRUE(decode_error_frame(0x01, {}).transmit_timeout);
  EXPECT_TRUE(decode_error_frame(0x02, {}).arbitration_lost);
  EXPECT_TRUE(decode_error_frame(0x08, {}).bus_error);
  EXPECT_TRUE(decode_error_frame(0x80, {}).bus_error);
  EXPECT_TRUE(decode_error_frame(0x10, {}).transceiver_fault);
  EXPECT_TRUE(decode_error_frame(0x20, {}).no_acknowledge);
  EXPECT_TRUE(decode_error_frame(0x04, Bytes{0, 0x01}).receive_overflow);
  EXPECT_TRUE(decode_error_frame(0x04, Bytes{0, 0x02}).transmit_overflow);
  EXPECT_FALSE(decode_error_frame(0x20, Bytes{0, 0x03}).receive_overflow);
}

TEST(ErrorFrame, CountersAreGivenOnlyWhereTheDriverGaveThem) {
  const auto passive = decode_error_frame(0x04, Bytes{0, 0x20, 0, 0, 0, 0, 128, 3});
  ASSERT_TRUE(passive.counters);
  EXPECT_EQ(passive.counters->transmit, 128);
  EXPECT_EQ(passive.counters->receive, 3);
  EXPECT_FALSE(decode_error_frame(0x04, Bytes{0, 0x40}).counters) << "both zero: an old driver that tells none";
  EXPECT_TRUE(decode_error_frame(0x204, Bytes{0, 0x40}).counters) << "both zero, and said to be so";
}

}  // namespace
