#include "src/steel/robot_bus.hpp"

#include <fmt/format.h>

#include "hw/canopen/bus_identifiers.hpp"
#include "src/config/config_error.hpp"

namespace hogline {
namespace {

std::vector<hw::CanFilter> filters(const std::vector<std::uint32_t>& ids) {
  std::vector<hw::CanFilter> result;
  for (const std::uint32_t id : ids) result.push_back({id});
  return result;
}

}  // namespace

hw::SocketCanConfig robot_bus_config(const std::string& interface, std::span<const std::uint8_t> nodes,
                                     std::uint8_t master_node, hw::BusDuties duties) {
  const hw::BusIdentifiers ids = hw::bus_identifiers(nodes, master_node, duties);
  hw::SocketCanConfig config;
  config.interface = interface;
  config.receive = filters(ids.heard);
  config.own = filters(ids.own);
  config.one_at_a_time = filters(ids.set_points);
  return config;
}

RobotBus::RobotBus(const config::Rig& rig, std::span<const std::uint8_t> nodes, std::uint8_t master_node,
                   hw::BusDuties duties, Stamp now) {
  open(rig, robot_bus_config(rig.can_interface, nodes, master_node, duties), now);
}

RobotBus::RobotBus(const config::Rig& rig, Stamp now) { open(rig, {.interface = rig.can_interface}, now); }

void RobotBus::open(const config::Rig& rig, const hw::SocketCanConfig& kernel, Stamp now) {
  if (rig.can_udp) {
    udp_.emplace(*rig.can_udp, now);
  } else if (!rig.can_interface.empty()) {
    kernel_.emplace(kernel, now);
  } else {
    throw config::ConfigError(rig.file, 0, "can.interface", "",
                              "missing; the robot's drives are on a CAN interface of this machine, e.g. can0");
  }
}

void RobotBus::step(Stamp now) {
  if (kernel_) kernel_->step(now);
  if (udp_) udp_->step(now);
}

hw::CanBus& RobotBus::bus() {
  if (kernel_) return *kernel_;
  return *udp_;
}

std::string describe_bus(const config::Rig& rig) {
  if (!rig.can_udp) return rig.can_interface;
  return fmt::format("{}:{} on {}", rig.can_udp->group, rig.can_udp->port, rig.can_udp->interface);
}

}  // namespace hogline
