// A configuration that can not be used is refused with key, value and what is allowed; units both ways.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "hw/canopen/axis_units.hpp"
#include "hw/canopen/drive_setup.hpp"
#include "tests/hw/canopen/drive_bench.hpp"

namespace hogline::hw::test {
namespace {

struct BadConfig {
  std::function<void(TwoWheelDriveConfig&)> spoil;
  const char* message;
};

TEST(DriveConfig, AGoodOneHasNoError) { EXPECT_EQ(config_error(drive_config()).value_or(""), ""); }

TEST(DriveConfig, AnUntouchedOneIsRefused) { EXPECT_TRUE(config_error(TwoWheelDriveConfig{})); }

TEST(DriveConfig, BadOnesNameKeyValueAndWhatIsAllowed) {
  const BadConfig rows[] = {
      {[](auto& c) { c.left.node = 0; }, "left.node is 0, allowed: 1..127"},
      {[](auto& c) { c.right.node = 128; }, "right.node is 128, allowed: 1..127"},
      {[](auto& c) { c.right.node = c.left.node; }, "must differ"},
      {[](auto& c) { c.master_node = 0; }, "master_node is 0"},
      {[](auto& c) { c.left.direction = 0; }, "left.direction is 0, allowed: +1 or -1"},
      {[](auto& c) { c.left.gear_ratio = unset; }, "left.gear_ratio is nan, allowed: finite and > 0"},
      {[](auto& c) { c.right.max_speed_radps = -1.0; }, "right.max_speed_radps is -1"},
      {[](auto& c) { c.right.quick_stop_radps2 = std::numeric_limits<double>::infinity(); },
       "quick_stop_radps2 is inf"},
      {[](auto& c) { c.left.velocity_units_per_motor_rps = 1e9; }, "drive units"},
      {[](auto& c) { c.left.quick_stop_radps2 = 1e-9; }, "drive units"},
      {[](auto& c) { c.left.vendor_id = 0; }, "left.vendor_id is 0"},
      {[](auto& c) { c.timing.control_period = 5500us; }, "timing.control_period [ms] is 5.5"},
      {[](auto& c) { c.timing.command_age_limit = 5ms; }, "must be shorter than timing.command_age_limit"},
      {[](auto& c) { c.timing.rpdo_timeout = 10ms; }, "must be shorter than timing.rpdo_timeout"},
      {[](auto& c) { c.timing.heartbeat_timeout = 50ms; }, "must be shorter than timing.heartbeat_timeout"},
      {[](auto& c) { c.plausibility.standstill_radps = unset; }, "plausibility.standstill_radps is nan"},
      {[](auto& c) { c.plausibility.speed_error_time = 0ms; }, "speed_error_time"},
  };
  for (const BadConfig& row : rows) {
    TwoWheelDriveConfig config = drive_config();
    row.spoil(config);
    const std::string error = config_error(config).value_or("");
    EXPECT_NE(error.find(row.message), std::string::npos) << "'" << error << "' should say '" << row.message << "'";
  }
}

TEST(WheelSetup, SafetyComesFirst) {
  const std::vector<SdoWrite> setup = wheel_setup(drive_config().left, {}, 127);
  const std::vector<std::uint16_t> first{0x1016, 0x6007, 0x605A, 0x605E, 0x6085};
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(setup[i].address.index, first[i]);
}

RC_GTEST_PROP(AxisUnits, SpeedRoundTripWithinHalfAUnit, ()) {
  WheelConfig wheel = drive_config().left;
  wheel.direction = *rc::gen::element(-1, 1);
  const double speed = *rc::gen::inRange(-30000, 30001) / 1000.0;
  const AxisUnits units(gearing(wheel));
  const double unit_radps = std::abs(units.radps(1));
  RC_ASSERT(std::abs(units.radps(units.velocity(speed)) - speed) <= 0.5 * unit_radps + 1e-12);
}

RC_GTEST_PROP(AxisUnits, TravelCrossesTheWrap, (std::int32_t from)) {
  const AxisUnits units(gearing(drive_config().left));
  const auto counts = *rc::gen::inRange(-1000000, 1000001);
  const auto to = static_cast<std::int32_t>(static_cast<std::uint32_t>(from) + static_cast<std::uint32_t>(counts));
  RC_ASSERT(std::abs(units.travel_rad(from, to) - counts * 2.0 * std::numbers::pi / 8192.0 / gear_ratio) < 1e-9);
}

}  // namespace
}  // namespace hogline::hw::test
