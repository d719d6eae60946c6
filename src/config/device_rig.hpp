// The devices that a rig file declares: all of them optional, for a robot need not be a whole thrower.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/head_config.hpp"
#include "hw/dsp3000/dsp3000_gyro.hpp"
#include "hw/dsp3000/serial_port.hpp"
#include "hw/link/link_config.hpp"
#include "hw/modbus/modbus_gripper.hpp"
#include "hw/modbus/modbus_session.hpp"
#include "src/config/rig.hpp"

namespace hogline::config {

struct GyroSection {
  hw::Dsp3000Config device;
  hw::SerialPortConfig port;
};

struct DeviceRig {
  Rig rig;
  std::optional<hw::TwoWheelDriveConfig> drive;
  std::optional<hw::TwoAxisHeadConfig> head;
  std::optional<hw::ModbusSessionConfig> modbus;
  std::optional<hw::ModbusGripperConfig> gripper;  ///< with modbus
  std::optional<hw::AxisConfig> arm;               ///< with modbus
  std::optional<GyroSection> gyro;
  std::optional<hw::link::LinkConfig> link;
  std::string operator_socket{};  ///< empty if the rig names none
};

/// Reads and checks whatever devices a rig file declares. Throws ConfigError.
DeviceRig load_device_rig(const std::string& path);

/// The same from text; `name` stands in messages.
DeviceRig parse_device_rig(std::string_view text, const std::string& name);

/// Whether the file has all that a throw needs.
bool is_thrower(const DeviceRig& rig);

}  // namespace hogline::config
