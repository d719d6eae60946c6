// Following set-points, ageing of commands, quick stop, and what the caller may not do.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/hw/can_text.hpp"
#include "tests/hw/canopen/drive_bench.hpp"

namespace hogline::hw::test {
namespace {

TEST(TwoWheelDriveMotion, BothWheelsGoForwardWhateverWayTheMotorsAreMounted) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  EXPECT_NEAR(bench.wheel_radps(0), 10.0, 0.01);
  EXPECT_NEAR(bench.wheel_radps(1), 10.0, 0.01);
  EXPECT_GT(bench.motor_radps[0], 0.0);
  EXPECT_LT(bench.motor_radps[1], 0.0);
  const DriveState state = bench.drive.state();
  EXPECT_NEAR(state.measured.left_radps, 10.0, 0.05);
  EXPECT_NEAR(state.measured.right_radps, 10.0, 0.05);
  EXPECT_LE(bench.now() - state.stamp, 10ms);
}

TEST(TwoWheelDriveMotion, ATurnOnTheSpotTurnsTheWheelsAgainstEachOther) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(0.0));
  bench.set_point = WheelSpeeds{-1.5, 1.5};
  bench.run(300ms);
  EXPECT_NEAR(bench.wheel_radps(0), -1.5, 0.01);
  EXPECT_NEAR(bench.wheel_radps(1), 1.5, 0.01);
}

TEST(TwoWheelDriveMotion, MeasuredSpeedHasNoBiasOverAThousandReadings) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(7.3));
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) {
    bench.run(5ms);
    sum += bench.drive.state().measured.right_radps;
  }
  EXPECT_NEAR(sum / 1000.0, 7.3, 0.002);
}

TEST(TwoWheelDriveMotion, ASetPointIsSentOnce) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(5.0));
  int commands = 0;
  bench.on_frame = [&commands](const StampedCanFrame& seen) { commands += seen.frame.id == 0x201 ? 1 : 0; };
  bench.set_point.reset();
  bench.drive.command({5.0, 5.0}, bench.now());
  bench.run(10ms);  // two control periods
  EXPECT_EQ(commands, 1);
}

TEST(TwoWheelDriveMotion, WithoutNewSetPointsItStopsWithinTheAgeLimit) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.set_point.reset();
  const auto detected = bench.run_until(DrivePhase::faulted, 1s);
  ASSERT_TRUE(detected);
  EXPECT_LE(*detected, 15ms + 5ms);
  EXPECT_EQ(bench.drive.state().error->kind, DeviceErrorKind::timeout);
  const auto stopped = bench.run_until([&bench] { return bench.standing(); }, 2s);
  ASSERT_TRUE(stopped);
  EXPECT_NEAR(seconds(*stopped), 10.0 / 25.0, 0.08) << "not on the quick-stop ramp";
}

TEST(TwoWheelDriveMotion, AnOldSetPointIsNotSent) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(5.0));
  bench.set_point.reset();
  bench.drive.command({9.0, 9.0}, bench.now() - 20ms);
  bench.run(300ms);
  EXPECT_LT(bench.fastest_radps, 5.1);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::faulted);
}

TEST(TwoWheelDriveMotion, QuickStopBrakesOnTheRampAndEndsWithoutPower) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(20.0));
  bench.drive.quick_stop();
  ASSERT_TRUE(
      bench.run_until([&bench] { return bench.left.quick_stop_active() && bench.right.quick_stop_active(); }, 20ms));
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::stopping);
  const auto ended = bench.run_until(DrivePhase::stopped, 3s);
  ASSERT_TRUE(ended);
  EXPECT_NEAR(seconds(*ended), 20.0 / 25.0, 0.1);
  EXPECT_TRUE(bench.standing());
  EXPECT_EQ(bench.left_power, sim::AxisPower::unpowered);
  EXPECT_FALSE(bench.drive.state().error);
}

TEST(TwoWheelDriveMotion, SetPointsDuringAndAfterAQuickStopMoveNothingUntilEnabledAgain) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.drive.quick_stop();  // the caller goes on commanding
  ASSERT_TRUE(bench.run_until(DrivePhase::stopped, 3s));
  bench.fastest_radps = 0.0;
  bench.run(1s);
  EXPECT_LT(bench.fastest_radps, 0.2);

  bench.set_point = WheelSpeeds{};
  bench.drive.enable();
  ASSERT_TRUE(bench.run_until(DrivePhase::enabled, 1s));
  bench.set_point = WheelSpeeds{2.0, 2.0};
  bench.run(300ms);
  EXPECT_NEAR(bench.wheel_radps(0), 2.0, 0.01);
}

TEST(TwoWheelDriveMotion, QuickStopWinsOverASetPointOfTheSameStep) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(5.0));
  bench.drive.quick_stop();
  bench.drive.command({5.0, 5.0}, bench.now());
  bench.run(10ms);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::stopping);
}

TEST(TwoWheelDriveMotion, EnableIsRefusedWhileBootingAndRearmWithoutAFaultDoesNothing) {
  DriveBench bench;
  bench.drive.enable();
  ASSERT_TRUE(bench.run_until(DrivePhase::ready, 2s));
  bench.run(500ms);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::ready);
  bench.drive.rearm();
  bench.run(5ms);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::ready);
}

struct BadSetPoint {
  const char* description;
  WheelSpeeds speeds;
};

class TwoWheelDriveBadSetPoint : public testing::TestWithParam<BadSetPoint> {};

TEST_P(TwoWheelDriveBadSetPoint, IsAFaultAndStopsBothWheels) {
  DriveBench bench;
  ASSERT_TRUE(bench.get_running(10.0));
  bench.set_point = GetParam().speeds;
  ASSERT_TRUE(bench.run_until(DrivePhase::faulted, 10ms));
  EXPECT_EQ(bench.drive.state().error->kind, DeviceErrorKind::implausible);
  ASSERT_TRUE(bench.run_until([&bench] { return bench.standing(); }, 1s));
  EXPECT_LT(bench.fastest_radps, 10.1);
}

INSTANTIATE_TEST_SUITE_P(Cases, TwoWheelDriveBadSetPoint,
                         testing::Values(BadSetPoint{"not a number", {std::numeric_limits<double>::quiet_NaN(), 10.0}},
                                         BadSetPoint{"infinite", {10.0, -std::numeric_limits<double>::infinity()}},
                                         BadSetPoint{"beyond the limit", {30.5, 10.0}},
                                         BadSetPoint{"far beyond 32 bits", {10.0, -1e300}}),
                         [](const auto& instance) { return "Case" + std::to_string(instance.index); });

TEST(TwoWheelDriveMotion, TheEncodersWrapWithoutNotice) {
  DriveBench bench;
  // 2^31 counts are 262144 motor revolutions; start just below.
  bench.left.axis().slip_encoder(262143.0);
  bench.right.axis().slip_encoder(-262143.0);
  ASSERT_TRUE(bench.get_running(20.0));
  bench.run(2s);
  EXPECT_EQ(bench.drive.state().phase, DrivePhase::enabled);
  EXPECT_GT(bench.left.axis().position_rev(), 262144.0);
}

}  // namespace
}  // namespace hogline::hw::test
