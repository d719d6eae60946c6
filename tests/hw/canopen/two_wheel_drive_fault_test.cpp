// The faults of doc/bus_maps.md: detected within the deadline, both wheels braked, nothing moves until re-armed.
#include <gtest/gtest.h>

#include "tests/hw/canopen/drive_bench.hpp"

namespace hogline::hw::test {
namespace {

struct Fault {
  const char* description;
  std::function<void(DriveBench&)> inject;
  std::function<void(DriveBench&)> heal;
  Duration deadline;  ///< from injection to detection, with one control period and the bus
  DeviceErrorKind kind;
  const char* what;
  bool left_brakes = true;  ///< false: the node is beyond reach and its axis is not the adapter's to stop
};

void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.description; }

sim::DeviceFaults& left_faults(DriveBench& bench) { return bench.left.communication().faults; }

const std::vector<Fault>& faults() {
  static const std::vector<Fault> table{
      {"heartbeat stops, the rest lives", [](DriveBench& b) { left_faults(b).heartbeat_stopped = true; },
       [](DriveBench& b) { left_faults(b).heartbeat_stopped = false; }, 160ms, DeviceErrorKind::timeout, "heartbeat"},
      {"TPDOs stop with a live heartbeat", [](DriveBench& b) { left_faults(b).tpdos_stopped = true; },
       [](DriveBench& b) { left_faults(b).tpdos_stopped = false; }, 35ms, DeviceErrorKind::timeout, "feedback"},
      {"TPDOs repeat old contents", [](DriveBench& b) { left_faults(b).tpdos_frozen = true; },
       [](DriveBench& b) { left_faults(b).tpdos_frozen = false; }, 60ms, DeviceErrorKind::implausible, "encoder"},
      {"TPDOs of wrong length", [](DriveBench& b) { left_faults(b).tpdos_short = true; },
       [](DriveBench& b) { left_faults(b).tpdos_short = false; }, 15ms, DeviceErrorKind::protocol, "wrong length"},
      {"the node dies, its holding brake closes", [](DriveBench& b) { b.left.kill(sim::AxisPower::braked); },
       [](DriveBench& b) { b.left.power_cycle(); }, 35ms, DeviceErrorKind::timeout, "feedback"},
      {"the node dies, its axis coasts", [](DriveBench& b) { b.left.kill(sim::AxisPower::unpowered); },
       [](DriveBench& b) { b.left.power_cycle(); }, 35ms, DeviceErrorKind::timeout, "feedback", false},
      {"the drive's supply fails for a moment", [](DriveBench& b) { b.left.power_cycle(); }, [](DriveBench&) {}, 35ms,
       DeviceErrorKind::device_fault, "unexpected boot-up", false},
      {"fault of the drive", [](DriveBench& b) { b.left.raise_fault(0x2310); }, [](DriveBench&) {}, 15ms,
       DeviceErrorKind::device_fault, "EMCY 2310 (current)"},
      {"EMCY without a change of state", [](DriveBench& b) { b.left.communication().emergency(0x8120, 0x10); },
       [](DriveBench&) {}, 15ms, DeviceErrorKind::device_fault, "EMCY 8120 (CAN error passive)"},
      {"flood of EMCY",
       [](DriveBench& b) {
         for (int i = 0; i < 30; ++i) b.left.communication().emergency(0x8110, 0x10);
       },
       [](DriveBench&) {}, 15ms, DeviceErrorKind::device_fault, "EMCY 8110"},
      {"statusword stuck at enabled while the speed diverges",
       [](DriveBench& b) {
         b.left.faults.statusword_stuck = true;
         b.left.faults.speed_stuck = true;
         b.set_point = WheelSpeeds{4.0, 4.0};
       },
       [](DriveBench& b) { b.left.faults = {}; }, 125ms, DeviceErrorKind::implausible, "does not follow", false},
      {"encoder jumps by two motor revolutions", [](DriveBench& b) { b.left.axis().slip_encoder(2.0); },
       [](DriveBench&) {}, 15ms, DeviceErrorKind::implausible, ""},
      {"the drive leaves the mode", [](DriveBench& b) { b.left.communication().objects().set(0x6060, 0, 3); },
       [](DriveBench&) {}, 15ms, DeviceErrorKind::device_fault, "mode 3"},
      {"somebody stops the node by NMT",
       [](DriveBench& b) {
         b.stray.send({.id = 0x000, .length = 2, .data = {0x02, 1}});
       },
       [](DriveBench&) {}, 15ms, DeviceErrorKind::protocol, "another master"},
      {"a second master commands the wheel",
       [](DriveBench& b) {
         b.stray.send({.id = 0x201, .length = 6, .data = {0x0F, 0x00, 0xFF, 0x7F}});
       },
       [](DriveBench&) {}, 15ms, DeviceErrorKind::protocol, "another master"},
  };
  return table;
}

class TwoWheelDriveFault : public testing::TestWithParam<Fault> {};

TEST_P(TwoWheelDriveFault, IsDetectedInTimeAndStopsBothWheels) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(20.0));
  GetParam().inject(bench);

  const auto detected = bench.run_until(DrivePhase::faulted, 1s);
  ASSERT_TRUE(detected);
  EXPECT_LE(*detected, GetParam().deadline);
  const DeviceError error = bench.drive.state().error.value();
  EXPECT_EQ(error.kind, GetParam().kind) << error.what;
  EXPECT_NE(error.what.find(GetParam().what), std::string::npos) << error.what;

  // The healthy wheel by its quick stop; the other as far as it can still be reached.
  const auto right_stands = bench.run_until([&bench] { return std::abs(bench.wheel_radps(1)) < 0.2; }, 2s);
  ASSERT_TRUE(right_stands);
  RecordProperty("detected_ms", static_cast<int>(*detected / 1ms));
  RecordProperty("stopped_ms", static_cast<int>((*detected + *right_stands) / 1ms));
  EXPECT_LE(*right_stands, 900ms);
  EXPECT_LT(bench.fastest_radps, 20.5);
  if (GetParam().left_brakes) {
    const auto left_stands = bench.run_until([&bench] { return std::abs(bench.wheel_radps(0)) < 0.2; }, 2s);
    ASSERT_TRUE(left_stands);
  }
}

TEST_P(TwoWheelDriveFault, NothingMovesOnRecoveryUntilRearmedAndEnabled) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(20.0));
  GetParam().inject(bench);
  bench.set_point = WheelSpeeds{4.0, 4.0};  // the caller goes on
  bench.run(3s);
  GetParam().heal(bench);
  bench.motor_radps = {};
  bench.fastest_radps = 0.0;
  bench.run(2s);
  EXPECT_LT(bench.fastest_radps, 0.01);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::faulted);

  bench.drive.enable();  // refused
  bench.run(1s);
  EXPECT_LT(bench.fastest_radps, 0.01);

  bench.drive.rearm();
  EXPECT_FALSE(bench.drive.state().error);
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 3s)) << bench.drive.state().error.value_or(DeviceError{}).what;
  bench.run(500ms);
  EXPECT_LT(bench.fastest_radps, 0.01);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::ready);

  ASSERT_TRUE(bench.get_running(5.0));
  EXPECT_NEAR(bench.wheel_radps(0), 5.0, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Table, TwoWheelDriveFault, testing::ValuesIn(faults()), [](const auto& instance) {
  std::string name;
  for (const char* c = instance.param.description; *c; ++c) name += std::isalnum(*c) ? *c : '_';
  return name;
});

TEST(TwoWheelDriveStop, AnIgnoredQuickStopIsReportedAndTheZeroSetPointBrakes) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.left.faults.quick_stop_ignored = true;
  bench.drive.quick_stop();
  const auto detected = bench.run_until(DrivePhase::faulted, 1s);
  ASSERT_TRUE(detected);
  EXPECT_LE(*detected, 65ms);
  EXPECT_NE(bench.drive.state().error->what.find("transition 11"), std::string::npos);
  ASSERT_TRUE(bench.run_until([&bench] { return bench.standing(); }, 1s));
  bench.run(2s);
  EXPECT_EQ(bench.left_power, sim::AxisPower::unpowered) << "power is taken away in the end";
}

TEST(TwoWheelDriveStop, AFaultDuringTheQuickStopStillEndsStanding) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(20.0));
  bench.drive.quick_stop();
  bench.run(200ms);
  bench.right.raise_fault(0x7500);
  ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 20ms));
  const auto stood = bench.run_until([&bench] { return bench.standing(); }, 2s);
  ASSERT_TRUE(stood);
  EXPECT_LE(*stood, 800ms);
}

TEST(TwoWheelDriveStop, ASecondFaultKeepsTheFirstReason) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(20.0));
  bench.left.raise_fault(0x2310);
  bench.run(50ms);
  bench.right.kill(sim::AxisPower::braked);
  bench.run(3s);
  EXPECT_EQ(bench.drive.state().error->device, "left wheel (node 1)");
}

TEST(TwoWheelDriveStop, RearmIsRefusedWhileTheWheelsStillTurn) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(20.0));
  bench.left.raise_fault(0x2310);
  bench.run(100ms);
  ASSERT_FALSE(bench.standing());
  bench.drive.rearm();
  EXPECT_TRUE(bench.drive.state().error);
  bench.run(50ms);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::faulted);
}

TEST(TwoWheelDriveStop, WhenTheProgramDiesTheDrivesStopByThemselves) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(20.0));
  bench.loop_stalled = true;
  const auto braking =
      bench.run_until([&bench] { return bench.left.quick_stop_active() && bench.right.quick_stop_active(); }, 1s);
  ASSERT_TRUE(braking);
  EXPECT_LE(*braking, 45ms) << "RPDO watchdog";
  const auto stood = bench.run_until([&bench] { return bench.standing(); }, 2s);
  ASSERT_TRUE(stood);
  EXPECT_NEAR(seconds(*stood), 20.0 / 25.0, 0.1);
}

TEST(TwoWheelDriveStop, AControlLoopThatComesLateFindsAFault) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.loop_stalled = true;
  bench.run(30ms);
  bench.loop_stalled = false;
  ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 10ms));
  EXPECT_NE(bench.drive.state().error->what.find("control loop"), std::string::npos);
  ASSERT_TRUE(bench.run_until([&bench] { return bench.standing(); }, 1s));
}

}  // namespace
}  // namespace hogline::hw::test
