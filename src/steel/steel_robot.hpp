// A thrower of steel: the devices that its rig file names, opened and behind the same ports as the simulated robot's.
#pragma once

#include <memory>
#include <optional>

#include "hw/canopen/can_hub.hpp"
#include "hw/canopen/two_axis_head.hpp"
#include "hw/canopen/two_wheel_drive.hpp"
#include "hw/checks/checked_camera.hpp"
#include "hw/clock.hpp"
#include "hw/dsp3000/dsp3000_gyro.hpp"
#include "hw/dsp3000/serial_port.hpp"
#include "hw/modbus/modbus_worker.hpp"
#include "src/config/thrower_rig.hpp"
#include "src/steel/robot_bus.hpp"
#include "src/throwing/thrower_devices.hpp"

namespace hogline {

/// The wheels, with all that shares their bus: a step reads the bus, then the head talks, then the
/// wheels, whose SYNC ends the period.
class BusDrive final : public hw::Drive {
 public:
  BusDrive(RobotBus& bus, hw::TwoWheelDrive& wheels, hw::TwoAxisHead* head) : bus_(bus), wheels_(wheels), head_(head) {}
  void step(Stamp now) override {
    bus_.step(now);
    if (head_ != nullptr) head_->step(now);
    wheels_.step(now);
  }
  hw::DriveState state() const override { return wheels_.state(); }
  void enable() override { wheels_.enable(); }
  void command(const hw::WheelSpeeds& speeds, Stamp now) override { wheels_.command(speeds, now); }
  void quick_stop() override { wheels_.quick_stop(); }
  void rearm() override { wheels_.rearm(); }

 private:
  RobotBus& bus_;
  hw::TwoWheelDrive& wheels_;
  hw::TwoAxisHead* head_;
};

/// Opens everything, switches nothing on: wheels and head boot by being stepped, without power; Modbus is talked to by
/// a thread of its own, cameras stream. What can not be opened is a device error at its port, not an exception. Ports
/// are used by one thread.
class SteelRobot {
 public:
  /// Throws ConfigError where the rig names no CAN bus, or a camera's pictures are simulated. Rig and clock must
  /// outlive the robot.
  SteelRobot(const config::ThrowerRig& rig, const hw::Clock& clock);
  SteelRobot(const SteelRobot&) = delete;
  SteelRobot& operator=(const SteelRobot&) = delete;

  /// What the thrower's loop drives; the operator's switch is the caller's.
  ThrowerDevices devices(hw::OperatorSwitch& operator_switch) {
    return {drive_, gripper(), arm(), gyro_, near_checked_, low_checked_, operator_switch, clock_};
  }

  hw::Drive& drive() { return drive_; }
  /// Stepped by the drive. Null where the rig has none.
  hw::Head* head() { return head_ ? &*head_ : nullptr; }
  hw::Gripper& gripper() { return modbus_.gripper(); }
  hw::Arm& arm() { return modbus_.arm(); }
  hw::Gyro& gyro() { return gyro_; }
  hw::Camera& near_camera() { return near_checked_; }
  hw::Camera& low_camera() { return low_checked_; }
  /// Of the kernel's interface; null on another bus.
  const hw::SocketCanState* can_state() const { return bus_.kernel_state(); }

 private:
  const hw::Clock& clock_;
  RobotBus bus_;
  hw::CanHub hub_;
  hw::TwoWheelDrive wheels_;
  std::optional<hw::TwoAxisHead> head_;
  BusDrive drive_;
  hw::ModbusWorker modbus_;
  hw::SerialPort gyro_port_;
  hw::Dsp3000Gyro gyro_;
  std::unique_ptr<hw::Camera> near_camera_;
  std::unique_ptr<hw::Camera> low_camera_;
  hw::CheckedCamera near_checked_;
  hw::CheckedCamera low_checked_;
};

}  // namespace hogline
