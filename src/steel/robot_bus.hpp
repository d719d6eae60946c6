// A CAN bus as a robot's bus: what it hears, what only it may say, and what is of no use when late.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "hw/canopen/drive_config.hpp"
#include "hw/socketcan/socket_can_bus.hpp"
#include "hw/udp_can/udp_can_bus.hpp"
#include "src/config/rig.hpp"

namespace hogline {

/// For a master of these nodes with these duties.
hw::SocketCanConfig robot_bus_config(const std::string& interface, std::span<const std::uint8_t> nodes,
                                     std::uint8_t master_node, hw::BusDuties duties = {});

/// The bus that a rig file names: the kernel's interface, or the one between programs. Not open yet is a state.
class RobotBus {
 public:
  /// For a master of these nodes with these duties. Throws ConfigError where the rig names no bus.
  RobotBus(const config::Rig& rig, std::span<const std::uint8_t> nodes, std::uint8_t master_node, hw::BusDuties duties,
           Stamp now);

  /// The devices' end: hears everything. Throws ConfigError where the rig names no bus.
  RobotBus(const config::Rig& rig, Stamp now);

  /// Every control period, before anything is received or sent.
  void step(Stamp now);
  hw::CanBus& bus();
  /// Of the kernel's interface; null on another bus.
  const hw::SocketCanState* kernel_state() const { return kernel_ ? &kernel_->state() : nullptr; }

 private:
  void open(const config::Rig& rig, const hw::SocketCanConfig& kernel, Stamp now);

  std::optional<hw::SocketCanBus> kernel_;
  std::optional<hw::UdpCanBus> udp_;
};

/// "vcan0", "239.74.163.2:43113 on lo"; empty if the rig names no bus.
std::string describe_bus(const config::Rig& rig);

}  // namespace hogline
