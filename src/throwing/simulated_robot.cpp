#include "src/throwing/simulated_robot.hpp"

#include <chrono>
#include <utility>
#include <variant>

#include "src/throwing/rink_of_rig.hpp"

namespace hogline {
namespace {

constexpr Stamp simulation_start{std::chrono::seconds{1}};  // the epoch stands for "never heard of"

hw::sim::ModbusWire wire_of(const hw::ModbusLineConfig& config) {
  return std::holds_alternative<hw::ModbusTcp>(config.line) ? hw::sim::ModbusWire::tcp : hw::sim::ModbusWire::rtu;
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
