// The kernel's CAN interface as a robot's bus: what it hears, what only it may say, and what is of no use when late.
#pragma once

#include <span>
#include <string>

#include "hw/canopen/drive_config.hpp"
#include "hw/socketcan/socket_can_bus.hpp"

namespace hogline {

/// For a master of these nodes with these duties.
hw::SocketCanConfig robot_bus_config(const std::string& interface, std::span<const std::uint8_t> nodes,
                                     std::uint8_t master_node, hw::BusDuties duties = {});

}  // namespace hogline
