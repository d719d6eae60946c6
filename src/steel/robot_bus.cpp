#include "src/steel/robot_bus.hpp"

#include "hw/canopen/bus_identifiers.hpp"

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

}  // namespace hogline
