// From power-up to ready: identity, configuration, deadlines.
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/hw/can_text.hpp"
#include "tests/hw/canopen/drive_bench.hpp"

namespace hogline::hw::test {
namespace {

TEST(TwoWheelDriveBoot, GetsReadyAndEnabled) {
  DriveBench bench;
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::booting);
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 2s)) << bench.drive.state().error.value_or(DeviceError{}).what;
  EXPECT_EQ(bench.drive.left().device_name(), "CURLING DRIVE 1");
  EXPECT_EQ(bench.left_power, sim::AxisPower::unpowered);

  bench.drive.enable();
  bench.set_point = WheelSpeeds{0.0, 0.0};
  ASSERT_TRUE(bench.run_until(DrivePhase::enabled, 1s));
  EXPECT_TRUE(bench.left.operation_enabled());
  EXPECT_TRUE(bench.right.operation_enabled());
  EXPECT_FALSE(bench.drive.state().error);
}

TEST(TwoWheelDriveBoot, WritesTheDrivesOwnWatchdogsAndReactions) {
  DriveBench bench;
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 2s));
  const sim::ObjectDictionary& objects = bench.left.communication().objects();
  EXPECT_EQ(objects.get(0x1016, 1), (127u << 16) | 150u);
  EXPECT_EQ(objects.get(0x1017), 50u);
  EXPECT_EQ(objects.get(0x1400, 5), 40u);
  EXPECT_EQ(objects.get(0x6007), 3u);
  EXPECT_EQ(objects.get(0x605A), 2u);
  EXPECT_EQ(objects.get(0x605E), 2u);
  EXPECT_EQ(objects.get(0x60C2, 1), 5u);
  EXPECT_EQ(objects.get_signed(0x60C2, 2), -3);
  EXPECT_EQ(objects.get_signed(0x6061), 9);
  EXPECT_EQ(objects.get(0x6085), 47746u);  // 25 rad/s^2 * 20 / 2 pi * 600
}

TEST(TwoWheelDriveBoot, ANodeThatComesLateIsWaitedFor) {
  sim::Cia402DriveConfig late = device_config(2);
  late.identity.boot_time = 2s;
  DriveBench bench(drive_config(), {}, device_config(1), late);
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 6s));
}

struct BootFault {
  const char* description;
  std::function<void(DriveBench&)> inject;
  DeviceErrorKind kind;
  const char* what;
};

class TwoWheelDriveBootFault : public testing::TestWithParam<BootFault> {};

TEST_P(TwoWheelDriveBootFault, EndsInATypedErrorAndNothingIsEnergised) {
  DriveBench bench;
  GetParam().inject(bench);
  ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 12s));
  const DeviceError error = bench.drive.state().error.value();
  EXPECT_EQ(error.kind, GetParam().kind) << error.what;
  EXPECT_EQ(error.device, "right wheel (node 2)");
  EXPECT_NE(error.what.find(GetParam().what), std::string::npos) << error.what;

  bench.drive.enable();
  bench.set_point = WheelSpeeds{5.0, 5.0};
  bench.run(1s);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::faulted);
  EXPECT_EQ(bench.fastest_radps, 0.0);
}

sim::ObjectDictionary& right_objects(DriveBench& bench) { return bench.right.communication().objects(); }

INSTANTIATE_TEST_SUITE_P(
    Cases, TwoWheelDriveBootFault,
    testing::Values(
        BootFault{"the node has no power", [](DriveBench& b) { b.right.kill(sim::AxisPower::unpowered); },
                  DeviceErrorKind::timeout, "never answered"},
        BootFault{"the node does not come back from reset communication",
                  [](DriveBench& b) {
                    b.run(60ms);
                    b.right.communication().faults.never_boots = true;
                  },
                  DeviceErrorKind::timeout, ""},
        BootFault{"another vendor's device", [](DriveBench& b) { right_objects(b).set(0x1018, 1, 0xBAD); },
                  DeviceErrorKind::refused, "wrong identity: 1018:01 is 00000BAD, expected 00C0FFEE"},
        BootFault{"another product", [](DriveBench& b) { right_objects(b).set(0x1018, 2, 7); },
                  DeviceErrorKind::refused, "1018:02"},
        BootFault{"not a drive", [](DriveBench& b) { right_objects(b).set(0x1000, 0, 0x00030191); },
                  DeviceErrorKind::refused, "1000:00 is 00000191"},
        BootFault{"an object is refused",
                  [](DriveBench& b) { right_objects(b).add(0x6085, 0, 4, sim::ObjectAccess::read_only, 1); },
                  DeviceErrorKind::refused, "SDO 6085:00: aborted 06010002"},
        BootFault{"the mode is never confirmed", [](DriveBench& b) { b.right.faults.mode_never_confirmed = true; },
                  DeviceErrorKind::refused, "6061"},
        BootFault{"SDO falls silent while configuring",
                  [](DriveBench& b) {
                    b.run_until([&b] { return b.drive.right().boot_stage() == NodeBoot::Stage::configure; }, 1s);
                    b.right.communication().faults.sdo_silent = true;
                  },
                  DeviceErrorKind::timeout, "no answer"},
        BootFault{"no heartbeat after the start",
                  [](DriveBench& b) { b.right.communication().faults.heartbeat_stopped = true; },
                  DeviceErrorKind::timeout, "heartbeat"},
        BootFault{"no TPDO after the start", [](DriveBench& b) { b.right.communication().faults.tpdos_stopped = true; },
                  DeviceErrorKind::timeout, "TPDO"}),
    [](const auto& instance) { return "Case" + std::to_string(instance.index); });

TEST(TwoWheelDriveBoot, AFaultFromBeforeIsResetByItsEdge) {
  DriveBench bench;
  bench.run(30ms);
  bench.left.raise_fault(0x3210);
  ASSERT_TRUE(bench.left.in_fault());
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 2s));
  EXPECT_FALSE(bench.left.in_fault());
}

TEST(TwoWheelDriveBoot, BootsOverABusThatTakesTime) {
  DriveBench bench(drive_config(), {.bit_rate_hz = 1e6});
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 2s));
}

TEST(TwoWheelDriveBoot, AnUnusableConfigurationIsRefused) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock);
  TwoWheelDriveConfig config = drive_config();
  config.left.gear_ratio = unset;
  EXPECT_THROW(TwoWheelDrive(bus.make_endpoint(), config), std::invalid_argument);
}

}  // namespace
}  // namespace hogline::hw::test
