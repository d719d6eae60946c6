// The faults of doc/bus_maps.md: detected within the deadline, both wheels braked, nothing moves until re-armed.
#include <gtest/gtest.h>

#include "tests/hw/canopen/can_faults.hpp"

namespace hogline::hw::test {
namespace {

constexpr double wheel_radius_m = 0.1;
constexpr double test_speed_radps = 2.5 / wheel_radius_m;

class CanFaultTest : public testing::TestWithParam<CanFault> {
 protected:
  DriveBench bench{drive_config(), {.bit_rate_hz = GetParam().bit_rate_hz}};
};

// The properties are the rows of a fault table; run with --gtest_output=json:FILE.
TEST_P(CanFaultTest, IsDetectedInTimeAndStopsTheRobot) {
  ASSERT_TRUE(bench.get_running(test_speed_radps));
  const Stamp injected = bench.now();
  bench.travel_rad = 0.0;
  GetParam().inject(bench);

  ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 1s));
  const Duration detected = bench.now() - injected;
  EXPECT_LE(detected, GetParam().deadline);
  const DeviceError error = bench.drive.state().error.value();
  EXPECT_EQ(error.kind, GetParam().kind) << error.what;
  EXPECT_NE(error.what.find(GetParam().what), std::string::npos) << error.what;

  // The healthy wheel by its quick stop, or by the drive's own watchdog; the other as far as it can still be reached.
  const auto right_stands = bench.run_until([this] { return std::abs(bench.wheel_radps(1)) < 0.2; }, 2s);
  ASSERT_TRUE(right_stands);
  EXPECT_LE(*right_stands, 1150ms) << "1 s of ramp, the command's way to the drive, and its lag";
  EXPECT_LT(bench.fastest_radps, test_speed_radps + 0.5);
  if (GetParam().left == CanFault::Left::brakes) {
    ASSERT_TRUE(bench.run_until([this] { return bench.standing(); }, 2s));
  }
  const Duration stopped = bench.now() - injected;
  RecordProperty("fault", GetParam().description);
  RecordProperty("noticed_by", error.device + ": " + error.what);
  RecordProperty("deadline_ms", static_cast<int>(GetParam().deadline / 1ms));
  RecordProperty("detected_ms", static_cast<int>(detected / 1ms));
  RecordProperty("stopped_ms", static_cast<int>(stopped / 1ms));
  RecordProperty("distance_mm", static_cast<int>(std::lround(1e3 * wheel_radius_m * bench.travel_rad)));
}

TEST_P(CanFaultTest, NothingMovesOnRecoveryUntilRearmedAndEnabled) {
  ASSERT_TRUE(bench.get_running(test_speed_radps));
  GetParam().inject(bench);
  ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 1s));
  bench.set_point = WheelSpeeds{4.0, 4.0};  // the caller goes on
  bench.run(3s);
  const std::string first = bench.drive.state().error->what;
  GetParam().heal(bench);
  bench.motor_radps = {};
  bench.fastest_radps = 0.0;
  bench.run(2s);
  EXPECT_LT(bench.fastest_radps, 0.01);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::faulted);
  EXPECT_EQ(bench.drive.state().error->what, first) << "the first reason stays";

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

INSTANTIATE_TEST_SUITE_P(Can, CanFaultTest, testing::ValuesIn(can_faults()),
                         [](const auto& instance) { return test_name(instance.param.description); });

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
