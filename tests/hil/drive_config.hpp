// The wheels' adapter against the foreign nodes 1 and 2, as tests and the program they kill use it.
#pragma once

#include "hw/canopen/two_wheel_drive.hpp"
#include "hw/socketcan/socket_can_bus.hpp"

namespace hogline::hil {

/// Deadlines that a busy test machine keeps; the shape of the conversation is that of 200 Hz.
hw::TwoWheelDriveConfig patient_drive_config();

/// Filters, own identifiers and one set-point at a time, as a robot's bus has them.
hw::SocketCanConfig wheels_bus_config(const std::string& interface);

}  // namespace hogline::hil
