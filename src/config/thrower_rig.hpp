// The part of the rig file that the thrower needs: its controller, its drives, its gripper and arm.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/head_config.hpp"
#include "hw/dsp3000/dsp3000_gyro.hpp"
#include "hw/dsp3000/serial_port.hpp"
#include "hw/modbus/modbus_arm.hpp"
#include "hw/modbus/modbus_gripper.hpp"
#include "hw/modbus/modbus_session.hpp"
#include "servo/thrower_config.hpp"
#include "src/config/device_rig.hpp"
#include "src/config/rig.hpp"
#include "src/throwing/look_times.hpp"

namespace hogline::config {

struct ThrowerRig {
  Rig rig;
  servo::ThrowerConfig thrower;
  hw::TwoWheelDriveConfig drive;
  std::optional<hw::TwoAxisHeadConfig> head;  ///< a thrower that only runs has none
  hw::ModbusSessionConfig modbus;
  hw::ModbusGripperConfig gripper;
  hw::AxisConfig arm;
  hw::Dsp3000Config gyro;
  hw::SerialPortConfig gyro_port;
  LookTimes looks;
  std::optional<hw::link::LinkConfig> link;  ///< a thrower that takes orders has one
  std::string operator_socket{};             ///< ... and somebody who holds the switch; empty if the rig names none
};

/// Its devices alone.
DeviceRig devices_of(const ThrowerRig& rig);

/// Reads and checks a rig file with every section that a throw needs. Throws ConfigError.
ThrowerRig load_thrower_rig(const std::string& path);

/// The same from text; `name` stands in messages.
ThrowerRig parse_thrower_rig(std::string_view text, const std::string& name);

}  // namespace hogline::config
