// Golden registers: the maker's examples for the jaws, doc/modbus.md for the axes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "hw/modbus/axis_registers.hpp"
#include "hw/modbus/robotiq_registers.hpp"

namespace hogline::hw {
namespace {

TEST(RobotiqRegisters, activation_is_the_makers_example) {
  const robotiq::Registers golden{0x0100, 0x0000, 0x0000};
  EXPECT_EQ(robotiq::encode({.activate = true}), golden);
}

TEST(RobotiqRegisters, open_fast_is_the_makers_example) {
  const robotiq::Registers golden{0x0900, 0x0000, 0xFFFF};
  EXPECT_EQ(robotiq::encode({.activate = true, .go_to = true, .position = 0, .speed = 255, .force = 255}), golden);
}

TEST(RobotiqRegisters, gripped_is_the_makers_example) {
  const auto status = robotiq::decode({0xB900, 0x00FF, 0xBD00});
  EXPECT_TRUE(status.activated);
  EXPECT_TRUE(status.go_to);
  EXPECT_EQ(status.activation, robotiq::Activation::active);
  EXPECT_EQ(status.object, robotiq::Object::contact_closing);
  EXPECT_EQ(status.fault, 0);
  EXPECT_EQ(status.position_echo, 0xFF);
  EXPECT_EQ(status.position, 0xBD);
}

TEST(RobotiqRegisters, opened_is_the_makers_example) {
  const auto status = robotiq::decode({0xF900, 0x0000, 0x0D00});
  EXPECT_EQ(status.object, robotiq::Object::at_position);
  EXPECT_EQ(status.position_echo, 0);
  EXPECT_EQ(status.position, 0x0D);
}

TEST(RobotiqRegisters, each_fault_has_words) {
  for (const int fault : {0x05, 0x07, 0x08, 0x09, 0x0A, 0x0B, 0x0C, 0x0D, 0x0E, 0x0F}) {
    const auto words = robotiq::describe_fault(static_cast<std::uint8_t>(fault));
    EXPECT_EQ(words.find("unknown"), std::string::npos) << fault;
  }
  EXPECT_NE(robotiq::describe_fault(0x42).find("unknown"), std::string::npos);
}

TEST(AxisRegisters, a_command_keeps_the_sign_of_its_argument) {
  const std::array<std::uint16_t, 3> golden{0x0007, 0x0001, 0xFB1E};
  EXPECT_EQ(axis::encode(7, {axis::belt::run, -1250}), golden);
}

TEST(AxisRegisters, a_status_is_read_field_by_field) {
  const auto status = axis::decode({0x4231, 7, 9, 0x0003, 0, 0xFB1E, 3000, 200});
  EXPECT_EQ(status.kind, static_cast<std::uint16_t>(axis::Kind::belt));
  EXPECT_EQ(status.sequence_echo, 7);
  EXPECT_EQ(status.watchdog_echo, 9);
  EXPECT_TRUE(status.moving);
  EXPECT_TRUE(status.at_target);
  EXPECT_FALSE(status.watchdog_tripped);
  EXPECT_FALSE(status.faulted);
  EXPECT_EQ(status.actual, -1250);
  EXPECT_EQ(status.limit, 3000);
  EXPECT_EQ(status.watchdog_ms, 200);
}

TEST(AxisRegisters, the_sequence_wraps_past_zero) {
  EXPECT_EQ(axis::next_sequence(0), 1);
  EXPECT_EQ(axis::next_sequence(0xFFFE), 0xFFFF);
  EXPECT_EQ(axis::next_sequence(0xFFFF), 1);
}

TEST(AxisRegisters, rates_that_do_not_fit_are_refused) {
  EXPECT_FALSE(axis::rate_argument(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(axis::rate_argument(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(axis::rate_argument(32.768));
  EXPECT_EQ(axis::rate_argument(-32.767), std::int16_t{-32767});
  EXPECT_EQ(axis::rate_argument(-32.768), std::int16_t{-32768}) << "the least that an int16 holds";
  EXPECT_FALSE(axis::rate_argument(-32.769));
}

RC_GTEST_PROP(AxisRegisters, rates_survive_the_round_trip, ()) {
  const auto argument = *rc::gen::inRange<int>(-32767, 32768);
  const double radps = 1e-3 * argument;
  RC_ASSERT(axis::rate_argument(radps) == static_cast<std::int16_t>(argument));
  RC_ASSERT(std::abs(axis::rate_radps(static_cast<std::int16_t>(argument)) - radps) < 1e-12);
}

RC_GTEST_PROP(RobotiqRegisters, any_registers_decode_to_fields_in_range, ()) {
  const auto words = *rc::gen::container<std::array<std::uint16_t, 3>>(rc::gen::arbitrary<std::uint16_t>());
  const auto status = robotiq::decode(words);
  RC_ASSERT(static_cast<int>(status.object) >= 0 && static_cast<int>(status.object) <= 3);
  RC_ASSERT(status.current_a >= 0.0 && status.current_a < 2.551);
}

}  // namespace
}  // namespace hogline::hw
