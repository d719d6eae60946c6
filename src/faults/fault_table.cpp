#include "src/faults/fault_case.hpp"

namespace hogline::faults {

const char* to_string(Group group) {
  switch (group) {
    case Group::can:
      return "CAN";
    case Group::modbus:
      return "Modbus";
    case Group::gyro:
      return "Gyro";
    case Group::camera:
      return "Camera";
    case Group::host:
      return "Host";
  }
  return "unknown";
}

const char* to_string(Strike strike) {
  switch (strike) {
    case Strike::power_on:
      return "at power-on";
    case Strike::measuring:
      return "measuring";
    case Strike::aligning:
      return "aligning";
    case Strike::speeding_up:
      return "speeding up";
    case Strike::full_speed:
      return "run";
    case Strike::braking:
      return "braking";
    case Strike::too_late:
      return "last metre";
    case Strike::released:
      return "release";
  }
  return "unknown";
}

const std::vector<Case>& fault_table() {
  static const std::vector<Case> table = [] {
    std::vector<Case> all;
    for (const auto& part :
         {can_node_faults(), can_bus_faults(), modbus_faults(), gyro_faults(), camera_faults(), host_faults()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return table;
}

}  // namespace hogline::faults
