// The sections of a rig file that declare devices.
#pragma once

#include "src/config/device_rig.hpp"
#include "src/config/section.hpp"
#include "src/config/strict_yaml.hpp"

namespace hogline::config {

/// Section `modbus`. Throws ConfigError.
hw::ModbusSessionConfig read_modbus(const Section& s, const Document& document);
/// Section `gripper`, or one of an axis (`arm`).
hw::ModbusGripperConfig read_gripper(const Section& s);
hw::AxisConfig read_axis(const Section& s);
/// Section `gyro`: the device, and the port that it is on.
hw::Dsp3000Config read_gyro_device(const Section& s);
hw::SerialPortConfig read_gyro_port(const Section& s);

/// All of a file's sections that declare devices; they have passed the schema. Throws ConfigError.
DeviceRig read_devices(const Rig& rig, const Section& root, const Document& document);

}  // namespace hogline::config
