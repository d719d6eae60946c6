// A robot on the simulated rink: the same adapters as on steel, connected to the rink's bus, port, bytes and pictures.
#pragma once

#include "hw/canopen/two_wheel_drive.hpp"
#include "hw/checks/checked_camera.hpp"
#include "hw/dsp3000/dsp3000_gyro.hpp"
#include "hw/modbus/modbus_arm.hpp"
#include "hw/modbus/modbus_gripper.hpp"
#include "hw/modbus/modbus_session.hpp"
#include "hw/operator_switch.hpp"
#include "hw/sim/rink.hpp"
#include "hw/sim/rink_cameras.hpp"
#include "src/config/thrower_rig.hpp"
#include "src/throwing/rink_gyro_line.hpp"
#include "src/throwing/rink_modbus_line.hpp"
#include "src/throwing/thrower_devices.hpp"

namespace hogline {

class SimulatedRobot {
 public:
  /// The scenario's wheel radius, track and stone place are taken from the rig. Pictures do not depend on the threads
  /// that render them.
  SimulatedRobot(const config::ThrowerRig& rig, hw::sim::Scenario scenario, int render_threads = 2);
  SimulatedRobot(const SimulatedRobot&) = delete;
  SimulatedRobot& operator=(const SimulatedRobot&) = delete;

  ThrowerDevices devices() {
    return {drive_, gripper_, arm_, gyro_, near_checked_, low_checked_, operator_switch_, rink_.clock()};
  }
  hw::HeldSwitch& operator_switch() { return operator_switch_; }
  hw::sim::Rink& rink() { return rink_; }
  const hw::sim::Scenario& scenario() const { return scenario_; }
  const hw::sim::Rink& rink() const { return rink_; }
  RinkGyroLine& gyro_line() { return gyro_line_; }
  hw::ModbusSession& session() { return session_; }
  hw::sim::RenderedCamera& near_camera() { return near_camera_; }
  hw::sim::RenderedCamera& low_camera() { return low_camera_; }

 private:
  hw::sim::Scenario scenario_;
  hw::sim::Rink rink_;
  hw::TwoWheelDrive drive_;
  RinkModbusLine modbus_line_;
  hw::ModbusSession session_;
  hw::ModbusGripper gripper_;
  hw::ModbusArm arm_;
  RinkGyroLine gyro_line_;
  hw::Dsp3000Gyro gyro_;
  hw::sim::RenderedCamera near_camera_;
  hw::sim::RenderedCamera low_camera_;
  hw::CheckedCamera near_checked_;
  hw::CheckedCamera low_checked_;
  hw::HeldSwitch operator_switch_;
};

}  // namespace hogline
