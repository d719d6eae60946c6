// From power-up to ready: identity, configuration, deadlines.
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/hw/canopen/can_faults.hpp"

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
  Duration deadline;
  DeviceErrorKind kind;
  const char* what;
};

void PrintTo(const BootFault& fault, std::ostream* out) { *out << fault.description; }

class CanBootFaultTest : public testing::TestWithParam<BootFault> {};

TEST_P(CanBootFaultTest, EndsInATypedErrorAndNothingIsEnergised) {
  DriveBench bench;
  GetParam().inject(bench);
  const Stamp injected = bench.now();
  ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 12s));
  const Duration detected = bench.now() - injected;
  EXPECT_LE(detected, GetParam().deadline);
  const DeviceError error = bench.drive.state().error.value();
  EXPECT_EQ(error.kind, GetParam().kind) << error.what;
  EXPECT_EQ(error.device, "right wheel (node 2)");
  EXPECT_NE(error.what.find(GetParam().what), std::string::npos) << error.what;
  RecordProperty("fault", GetParam().description);
  RecordProperty("noticed_by", error.device + ": " + error.what);
  RecordProperty("deadline_ms", static_cast<int>(GetParam().deadline / 1ms));
  RecordProperty("detected_ms", static_cast<int>(detected / 1ms));

  bench.drive.enable();
  bench.set_point = WheelSpeeds{5.0, 5.0};
  bench.run(1s);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::faulted);
  EXPECT_EQ(bench.fastest_radps, 0.0);
}

sim::ObjectDictionary& right_objects(DriveBench& bench) { return bench.right.communication().objects(); }
sim::DeviceFaults& right_faults(DriveBench& bench) { return bench.right.communication().faults; }

bool configures(DriveBench& bench) {
  return bench.run_until([&bench] { return bench.drive.right().boot_stage() == NodeBoot::Stage::configure; }, 1s)
      .has_value();
}

const std::vector<BootFault> boot_faults{
    {"never boots: the node has no power", [](DriveBench& b) { b.right.kill(sim::AxisPower::unpowered); }, 5010ms,
     DeviceErrorKind::timeout, "never answered"},
    {"never boots: no boot-up after reset communication",
     [](DriveBench& b) {
       b.run(60ms);
       right_faults(b).never_boots = true;
     },
     5100ms, DeviceErrorKind::timeout, ""},
    {"wrong identity: another vendor", [](DriveBench& b) { right_objects(b).set(0x1018, 1, 0xBAD); }, 150ms,
     DeviceErrorKind::refused, "wrong identity: 1018:01 is 00000BAD, expected 00C0FFEE"},
    {"wrong identity: another product", [](DriveBench& b) { right_objects(b).set(0x1018, 2, 7); }, 150ms,
     DeviceErrorKind::refused, "1018:02"},
    {"wrong identity: not a drive", [](DriveBench& b) { right_objects(b).set(0x1000, 0, 0x00030191); }, 150ms,
     DeviceErrorKind::refused, "1000:00 is 00000191"},
    {"duplicate id: two nodes answer",
     [](DriveBench& b) {
       b.intruder = std::make_unique<sim::Cia402DriveDevice>(b.bus.make_endpoint(), device_config(2));
     },
     150ms, DeviceErrorKind::protocol, "breaks the protocol"},
    {"duplicate id: a second node boots later",
     [](DriveBench& b) {
       ASSERT_TRUE(configures(b));
       b.intruder = std::make_unique<sim::Cia402DriveDevice>(b.bus.make_endpoint(), device_config(2));
     },
     30ms, DeviceErrorKind::device_fault, "another node has its id"},
    {"SDO abort", [](DriveBench& b) { right_objects(b).add(0x6085, 0, 4, sim::ObjectAccess::read_only, 1); }, 500ms,
     DeviceErrorKind::refused, "SDO 6085:00: aborted 06010002"},
    {"SDO timeout",
     [](DriveBench& b) {
       ASSERT_TRUE(configures(b));
       right_faults(b).sdo_silent = true;
     },
     110ms, DeviceErrorKind::timeout, "no answer"},
    {"SDO toggle bit stuck", [](DriveBench& b) { right_faults(b).sdo_toggle_stuck = true; }, 150ms,
     DeviceErrorKind::protocol, "toggle"},
    {"SDO wrong echo",
     [](DriveBench& b) {
       ASSERT_TRUE(configures(b));
       right_faults(b).sdo_wrong_echo = true;
     },
     20ms, DeviceErrorKind::protocol, "breaks the protocol"},
    {"SDO confirms the heartbeat watchdog and forgets it",
     [](DriveBench& b) { right_faults(b).sdo_ignores = 0x101601; }, 800ms, DeviceErrorKind::refused,
     "1016:01: confirmed 007F0096 but holds 00000000"},
    {"SDO confirms the reaction to a lost connection and forgets it",
     [](DriveBench& b) { right_faults(b).sdo_ignores = 0x600700; }, 800ms, DeviceErrorKind::refused, "6007:00"},
    {"SDO confirms the RPDO watchdog and forgets it", [](DriveBench& b) { right_faults(b).sdo_ignores = 0x140005; },
     800ms, DeviceErrorKind::refused, "1400:05: confirmed 00000028 but holds 00000000"},
    {"mode never confirms", [](DriveBench& b) { b.right.faults.mode_never_confirmed = true; }, 5800ms,
     DeviceErrorKind::refused, "6061"},
    {"no heartbeat after the start", [](DriveBench& b) { right_faults(b).heartbeat_stopped = true; }, 5800ms,
     DeviceErrorKind::timeout, "heartbeat"},
    {"no TPDO after the start", [](DriveBench& b) { right_faults(b).tpdos_stopped = true; }, 5800ms,
     DeviceErrorKind::timeout, "TPDO"},
};

INSTANTIATE_TEST_SUITE_P(Can, CanBootFaultTest, testing::ValuesIn(boot_faults),
                         [](const auto& instance) { return test_name(instance.param.description); });

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
