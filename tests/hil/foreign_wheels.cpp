#include "tests/hil/foreign_wheels.hpp"

#include <cmath>

namespace hogline::hil {

using namespace hogline::hw;

ForeignWheels::ForeignWheels(const TwoWheelDriveConfig& config)
    : bus(wheels_bus_config("vcan0"), now()), drive(bus, config) {
  EXPECT_TRUE(run_until(bus, [&] { return bus.up(); }));
}

testing::AssertionResult ForeignWheels::run_at(const WheelSpeeds& speeds) {
  if (!drive_until(DrivePhase::ready)) return testing::AssertionFailure() << "does not boot: " << why();
  drive.enable();
  if (!drive_until(DrivePhase::enabled)) return testing::AssertionFailure() << "is not enabled: " << why();
  const auto turn = [&] {
    const WheelSpeeds measured = drive.state().measured;
    return std::abs(measured.left_radps - speeds.left_radps) < 0.01 &&
           std::abs(measured.right_radps - speeds.right_radps) < 0.01;
  };
  if (!drive_until(speeds, turn)) return testing::AssertionFailure() << "does not follow: " << why();
  return testing::AssertionSuccess();
}

bool ForeignWheels::drive_until(DrivePhase phase, const WheelSpeeds& speeds) {
  return drive_until(speeds, [&] { return drive.state().phase == phase; });
}

bool ForeignWheels::drive_until(const WheelSpeeds& speeds, const std::function<bool()>& done) {
  const auto one_period = [&] {
    bus.step(now());
    if (drive.state().phase == DrivePhase::enabled) drive.command(speeds, now());
    drive.step(now());
    return done() || (drive.state().error && drive.state().phase == DrivePhase::faulted);
  };
  return wait_until(one_period, generous, 5ms) && done();
}

bool ForeignWheels::command_until(const WheelSpeeds& speeds, const std::function<bool()>& done) {
  const auto one_period = [&] {
    bus.step(now());
    drive.command(speeds, now());
    drive.step(now());
    return done();
  };
  return wait_until(one_period, generous, 5ms);
}

bool ForeignWheels::left_stands() const { return std::abs(drive.state().measured.left_radps) < 0.05; }

std::string ForeignWheels::why() const {
  const auto error = drive.state().error;
  return error ? error->device + ": " + error->what : "no error";
}

}  // namespace hogline::hil
