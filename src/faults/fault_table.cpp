#include <algorithm>
#include <cctype>
#include <utility>

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
    case Strike::rehearsing:
      return "rehearsing";
    case Strike::set_down:
      return "stone set down";
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

namespace {

void append(std::vector<Case>& table, Group group, std::vector<Case> rows) {
  for (Case& row : rows) {
    row.group = group;
    table.push_back(std::move(row));
  }
}

}  // namespace

const std::vector<Case>& fault_table() {
  static const std::vector<Case> table = [] {
    std::vector<Case> all;
    append(all, Group::can, can_node_faults());
    append(all, Group::can, can_bus_faults());
    append(all, Group::modbus, modbus_faults());
    append(all, Group::gyro, gyro_faults());
    append(all, Group::camera, camera_faults());
    append(all, Group::host, host_faults());
    return all;
  }();
  return table;
}

bool mentions(const Case& fault, std::string_view words) {
  const std::string all = std::string(to_string(fault.group)) + " " + fault.name + " " + fault.injected;
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(all.begin(), all.end(), words.begin(), words.end(), same) != all.end();
}

}  // namespace hogline::faults
