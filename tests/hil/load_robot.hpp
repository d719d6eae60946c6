// What both load tests have in common: four drives on one bus, the kernel's own count of the frames on it, and what
// the two adapters say of themselves.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hw/canopen/two_axis_head.hpp"
#include "hw/canopen/two_wheel_drive.hpp"
#include "hw/socketcan/socket_can_bus.hpp"

namespace hogline::hil {

/// Left wheel, right wheel, pan, tilt.
inline constexpr std::array<std::uint8_t, 4> load_nodes{1, 2, 3, 4};

/// The robot's own bus, but a frame may wait for two seconds: stalls of the machine are no faults of the bus.
hw::SocketCanConfig patient_bus(const std::string& interface);

/// Frames sent on the interface since it was made, by anybody.
long frames_on(const std::string& interface);

bool both(const hw::TwoWheelDrive& wheels, const hw::TwoAxisHead& head, hw::DrivePhase phase);

/// The first error of the two, for a failing test's message.
std::string why(const hw::TwoWheelDrive& wheels, const hw::TwoAxisHead& head);

}  // namespace hogline::hil
