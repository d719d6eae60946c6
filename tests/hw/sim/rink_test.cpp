// The whole rink through the program's own adapters: what a controller would do, as a script.
#include "hw/sim/rink.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "hw/canopen/two_wheel_drive.hpp"
#include "hw/dsp3000/dsp3000_gyro.hpp"
#include "tests/hw/modbus/adapter_config.hpp"
#include "tests/hw/sim/reference_scenario.hpp"
#include "tests/hw/sim/reference_wheels.hpp"

namespace hogline::hw::sim {
namespace {

using namespace std::chrono_literals;

constexpr Duration period = 5ms;
WheelConfig wheel_config(const char* name, std::uint8_t node, int direction) {
  WheelConfig wheel;
  wheel.name = name;
  wheel.node = node;
  wheel.vendor_id = 0x2F1;
  wheel.product_code = 0x402;
  wheel.direction = direction;
  wheel.gear_ratio = wheel_gear;
  wheel.position_counts_per_motor_rev = wheel_counts;
  wheel.velocity_units_per_motor_rps = wheel_units;
  wheel.acceleration_units_per_motor_rps2 = wheel_units;
  wheel.max_speed_radps = 45.0;
  wheel.quick_stop_radps2 = 25.0;
  return wheel;
}

TwoWheelDriveConfig drive_config() {
  TwoWheelDriveConfig config;
  config.left = wheel_config("left wheel", 1, 1);
  config.right = wheel_config("right wheel", 2, -1);
  config.master_node = 127;
  config.plausibility = {
      .standstill_radps = 0.05, .speed_error_radps = 5.0, .speed_error_time = 200ms, .position_mismatch_rad = 0.5};
  return config;
}

Scenario scenario_of(std::uint64_t seed) {
  auto scenario = exact_scenario();
  scenario.seed = seed;
  scenario.drive = {.bandwidth_hz = 15.0, .dead_time_s = 0.005};
  scenario.gyro.angle_random_walk_rad_per_sqrt_s = 2e-5;
  scenario.robot.yaw_disturbance_radps = 0.003;
  return scenario;
}

class GyroLine final : public ByteLine {
 public:
  explicit GyroLine(Rink& rink) : rink_(rink) {}
  std::optional<std::string> open() override { return std::nullopt; }
  void close() override {}
  std::optional<std::string> read() override { return rink_.read_gyro(); }
  bool write(std::string_view bytes) override {
    rink_.gyro().write(bytes);
    return true;
  }

 private:
  Rink& rink_;
};

Dsp3000Config gyro_config() {
  return {.sign = 1.0,
          .latency = 3ms,
          .silence_limit = 30ms,
          .mode_deadline = 500ms,
          .reopen_delay = 200ms,
          .max_rate_radps = 6.5,
          .max_slew_radps2 = 100.0,
          .stuck_limit = 1h,  // this rink's gyro has no noise
          .rest_window = 500ms,
          .max_bias_radps = 0.1,
          .max_bias_step_radps = 0.1};
}

// The program's side: real adapters, and a script instead of a controller.
class Program {
 public:
  explicit Program(const Scenario& scenario)
      : rink({.scenario = scenario, .left = wheel_rig(1, 1), .right = wheel_rig(2, -1), .bus = {.bit_rate_hz = 1e6}},
             Stamp{} + 1s),
        drive(rink.can(), drive_config()),
        session({.line = {.line = ModbusTcp{"127.0.0.1", rink.modbus_port()}, .response_timeout = 500ms},
                 .reconnect_delay = 200ms}),
        gripper(session, gripper_config(3.0)),
        arm(session, arm_config()),
        gyro_line(rink),
        gyro(gyro_line, gyro_config()) {}

  void step() {
    rink.step(period);
    drive.step(rink.now());
    gripper.step(rink.now());
    arm.step(rink.now());
    gyro.step(rink.now());
  }
  template <typename Reached>
  bool step_until(Reached&& reached, Duration deadline) {
    for (const Stamp end = rink.now() + deadline; rink.now() < end;) {
      if (reached()) return true;
      step();
    }
    return reached();
  }
  bool boot_and_enable() {
    if (!step_until([&] { return drive.state().phase == DrivePhase::ready; }, 5s)) return false;
    drive.enable();
    return step_until([&] { return drive.state().phase == DrivePhase::enabled; }, 2s);
  }
  void ramp_to(double speed_radps, double acceleration_radps2) {
    while (axis_radps != speed_radps) {
      const double most = acceleration_radps2 * seconds(period);
      axis_radps += std::clamp(speed_radps - axis_radps, -most, most);
      drive_on();
    }
  }
  void drive_on() {
    drive.command({axis_radps, axis_radps}, rink.now());
    step();
  }
  std::string faults() const {
    std::string all;
    for (const auto& error : {drive.state().error, gripper.state().error, arm.state().error, gyro.state().error}) {
      if (error) all += error->device + ": " + error->what + "; ";
    }
    return all;
  }

  Rink rink;
  TwoWheelDrive drive;
  ModbusSession session;
  ModbusGripper gripper;
  ModbusArm arm;
  GyroLine gyro_line;
  Dsp3000Gyro gyro;
  double axis_radps = 0.0;
};

void deliver(Program& program) {
  program.arm.fold();
  program.gripper.spin(1.5);
  ASSERT_TRUE(program.step_until([&] { return program.arm.state().position == ArmPosition::folded; }, 3s));
  ASSERT_TRUE(program.boot_and_enable()) << program.faults();
  program.ramp_to(20.9, 4.0);
  program.gripper.release();
  while (program.rink.truth().held) program.drive_on();
  program.ramp_to(0.0, 12.0);
  program.drive.quick_stop();
  program.step();
}

TEST(Rink, a_scripted_throw_goes_through_every_bus) {
  Program program(scenario_of(3));
  deliver(program);
  EXPECT_EQ(program.faults(), "");
  const auto& truth = program.rink.truth();
  ASSERT_TRUE(truth.release);
  EXPECT_NEAR(truth.release->speed_mps, 2.09, 0.01);
  EXPECT_NEAR(truth.release->spin_radps, 1.5, 0.02);
  EXPECT_NEAR(truth.release->heading_rad, 0.0, 0.01);
  EXPECT_FALSE(truth.burned);
  EXPECT_FALSE(truth.slipping);
  ASSERT_TRUE(program.step_until([&] { return std::hypot(truth.stone.vx_mps, truth.stone.vy_mps) == 0.0; }, 40s));
  EXPECT_LT(truth.stone.x_m, -0.5) << "counter-clockwise curls left";
  EXPECT_GT(truth.stone.y_m, 25.0);
}

TEST(Rink, a_stone_set_down_in_the_hack_is_gripped_again_and_not_delivered) {
  Program program(scenario_of(3));
  ASSERT_TRUE(program.step_until([&] { return program.gripper.state().jaws == JawState::holding; }, 1s));
  const auto& truth = program.rink.truth();
  const double y_m = truth.stone.y_m;
  for (int i = 0; i < 3; ++i) {
    program.gripper.release();
    program.gripper.step(program.rink.now());
    const Stamp ordered = program.rink.now();
    ASSERT_TRUE(program.step_until([&] { return program.gripper.state().freed_at >= ordered; }, 1s));
    ASSERT_TRUE(truth.set_down);
    EXPECT_FALSE(truth.held);
    EXPECT_NEAR(seconds(*program.gripper.state().freed_at - *truth.set_down), 0.0, 0.003)
        << "by its own report, in whole counts";
    program.gripper.grip();
    ASSERT_TRUE(program.step_until([&] { return program.gripper.state().jaws == JawState::holding; }, 2s));
    program.step();
    EXPECT_TRUE(truth.held);
    EXPECT_FALSE(truth.set_down);
  }
  EXPECT_FALSE(truth.release);
  EXPECT_FALSE(truth.burned);
  EXPECT_EQ(truth.stone.y_m, y_m);
  deliver(program);
  ASSERT_TRUE(truth.release) << "and is then delivered as any other";
  EXPECT_EQ(program.faults(), "");
}

TEST(Rink, jaws_that_close_beside_the_stone_close_on_nothing) {
  Program program(scenario_of(3));
  program.gripper.release();
  ASSERT_TRUE(program.step_until([&] { return program.rink.truth().set_down.has_value(); }, 1s));
  ASSERT_TRUE(program.boot_and_enable()) << program.faults();
  program.ramp_to(-2.0, 4.0);  // the robot backs off
  program.ramp_to(0.0, 4.0);
  program.gripper.grip();
  ASSERT_TRUE(program.step_until([&] { return program.gripper.state().jaws == JawState::closed_empty; }, 3s));
  EXPECT_FALSE(program.rink.truth().held);
}

TEST(Rink, measured_wheels_and_gyro_agree_with_the_truth) {
  Program program(scenario_of(3));
  ASSERT_TRUE(program.boot_and_enable()) << program.faults();
  program.ramp_to(10.0, 4.0);
  for (int i = 0; i < 20; ++i) program.drive_on();
  const auto state = program.drive.state();
  EXPECT_NEAR(state.measured.left_radps, program.rink.truth().left_wheel_radps, 0.05);
  EXPECT_NEAR(state.measured.right_radps, program.rink.truth().right_wheel_radps, 0.05);
  EXPECT_TRUE(program.gyro.state().valid);
  EXPECT_NEAR(program.gyro.state().rate_radps, program.rink.truth().twist.yaw_radps, 2e-3);
}

TEST(Rink, the_program_that_falls_silent_is_stopped_by_the_drives_and_keeps_the_stone) {
  Program program(scenario_of(3));
  ASSERT_TRUE(program.boot_and_enable()) << program.faults();
  program.ramp_to(20.0, 4.0);
  for (int i = 0; i < 400; ++i) program.rink.step(period);
  EXPECT_NEAR(program.rink.truth().twist.forward_mps, 0.0, 0.01);
  EXPECT_TRUE(program.rink.truth().held);
}

TEST(Rink, the_same_seed_gives_the_same_frames_and_the_same_truth) {
  const auto run = [](std::uint64_t seed) {
    Program program(scenario_of(seed));
    std::ostringstream bytes;
    program.rink.bus().set_tap([&](const StampedCanFrame& heard) {
      bytes << heard.stamp.time_since_epoch().count() << ':' << heard.frame.id << ':';
      for (const auto byte : heard.frame.data) bytes << static_cast<int>(byte) << ',';
    });
    deliver(program);
    bytes.precision(17);
    bytes << program.rink.truth().stone.x_m << ' ' << program.rink.truth().body.yaw_rad << ' '
          << program.gyro.state().rate_radps;
    return bytes.str();
  };
  const auto first = run(5);
  EXPECT_EQ(first, run(5));
  EXPECT_NE(first, run(6));
}

TEST(WorldHistory, places_between_two_samples_lie_between_them) {
  WorldHistory history(1s);
  Truth truth;
  for (int i = 0; i <= 10; ++i) {
    truth.stamp = Stamp{} + i * 1ms;
    truth.body.y_m = 0.002 * i;
    truth.pitch_rad = 0.001 * i;
    history.add(truth);
  }
  const auto place = history.at(Stamp{} + 4250us);
  EXPECT_NEAR(place.body.y_m, 0.0085, 1e-12);
  EXPECT_NEAR(place.pitch_rad, 0.00425, 1e-12);
  EXPECT_NEAR(place.pitch_rate_radps, 1.0, 1e-9);
  EXPECT_NEAR(history.at(Stamp{} - 1s).body.y_m, 0.0, 1e-12) << "the oldest";
  EXPECT_NEAR(history.at(Stamp{} + 1s).body.y_m, 0.02, 1e-12) << "the newest";
}

}  // namespace
}  // namespace hogline::hw::sim
