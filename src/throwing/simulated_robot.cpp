#include "src/throwing/simulated_robot.hpp"

#include <chrono>
#include <utility>
#include <variant>

namespace hogline {
namespace {

constexpr Stamp simulation_start{std::chrono::seconds{1}};  // the epoch stands for "never heard of"

hw::sim::Scenario completed(hw::sim::Scenario scenario, const config::ThrowerRig& rig) {
  scenario.robot.wheel_radius_m = rig.thrower.base.wheel_radius_m;
  scenario.robot.track_m = rig.thrower.base.track_m;
  scenario.stone.stone_x_m = rig.thrower.release.stone_x_m;
  scenario.gyro.binary = rig.gyro.variant == hw::Dsp3000Variant::binary;
  if (scenario.gyro.binary) scenario.gyro.line_rate_hz *= 10.0;
  return scenario;
}

// The drive as the rig file expects to find it.
hw::sim::WheelRig wheel_rig(const hw::WheelConfig& wheel) {
  hw::sim::WheelRig rig;
  auto& d = rig.device;
  d.identity.node = wheel.node;
  d.identity.device_type = 0x00020192;
  d.identity.vendor_id = wheel.vendor_id;
  d.identity.product_code = wheel.product_code;
  d.identity.name = wheel.name;
  d.axis.encoder_counts_per_rev = wheel.position_counts_per_motor_rev;
  d.axis.velocity_window_s = 0.005;
  d.position_counts_per_rev = wheel.position_counts_per_motor_rev;
  d.velocity_units_per_rps = wheel.velocity_units_per_motor_rps;
  d.acceleration_units_per_rps2 = wheel.acceleration_units_per_motor_rps2;
  d.switch_on_time_s = 0.02;
  rig.gear_ratio = wheel.gear_ratio;
  rig.direction = wheel.direction;
  return rig;
}

hw::sim::RinkConfig rink_config(const config::ThrowerRig& rig, const hw::sim::Scenario& scenario) {
  constexpr double bit_rate_hz = 1e6;
  return {.scenario = scenario,
          .left = wheel_rig(rig.drive.left),
          .right = wheel_rig(rig.drive.right),
          .bus = {.bit_rate_hz = bit_rate_hz}};
}

hw::sim::ModbusWire wire_of(const hw::ModbusLineConfig& config) {
  return std::holds_alternative<hw::ModbusTcp>(config.line) ? hw::sim::ModbusWire::tcp : hw::sim::ModbusWire::rtu;
}

hw::sim::CameraRig camera_rig(const vision::CameraSetup& setup) {
  return {.intrinsics = setup.intrinsics, .mount = setup.mount, .gamma = setup.gamma};
}

hw::CameraWatch watch_of(const config::Rig& rig, const std::string& camera) {
  const config::CameraSource source = rig.source(camera);
  return {.name = camera + " camera", .max_age = source.max_age, .silence_limit = source.silence_limit};
}

}  // namespace

SimulatedRobot::SimulatedRobot(const config::ThrowerRig& rig, hw::sim::Scenario scenario, int render_threads)
    : scenario_(completed(std::move(scenario), rig)),
      rink_(rink_config(rig, scenario_), simulation_start),
      drive_(rink_.can(), rig.drive),
      modbus_line_(rink_.modbus(), wire_of(rig.modbus.line)),
      session_(rig.modbus, hw::stepped_line(modbus_line_)),
      gripper_(session_, rig.gripper),
      arm_(session_, rig.arm),
      gyro_line_(rink_),
      gyro_(gyro_line_, rig.gyro),
      near_camera_(hw::sim::near_camera(rink_, scenario_, camera_rig(*rig.rig.near_camera), render_threads)),
      low_camera_(hw::sim::low_camera(rink_, scenario_, camera_rig(*rig.rig.low_camera), render_threads)),
      near_checked_(near_camera_, watch_of(rig.rig, "near")),
      low_checked_(low_camera_, watch_of(rig.rig, "low")) {}

}  // namespace hogline
