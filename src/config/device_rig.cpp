#include "src/config/device_rig.hpp"

#include <fmt/format.h>

#include "src/config/config_error.hpp"
#include "src/config/device_sections.hpp"
#include "src/config/drive_sections.hpp"
#include "src/config/link_section.hpp"

namespace hogline::config {
namespace {

// A head without wheels is its own master, with the usual times.
hw::TwoWheelDriveConfig no_wheels() {
  constexpr std::uint8_t usual_master = 127;
  hw::TwoWheelDriveConfig none;
  none.master_node = usual_master;
  return none;
}

}  // namespace

DeviceRig read_devices(const Rig& rig, const Section& root, const Document& document) {
  DeviceRig devices{
      .rig = rig, .drive = {}, .head = {}, .modbus = {}, .gripper = {}, .arm = {}, .gyro = {}, .link = {}};
  if (root.has("drive")) devices.drive = read_drive(root.section("drive"), document);
  if (root.has("head")) {
    devices.head = read_head(root.section("head"), devices.drive.value_or(no_wheels()), document);
    if (!devices.drive) devices.head->duties = {};
  }
  if (root.has("modbus")) devices.modbus = read_modbus(root.section("modbus"), document);
  for (const char* behind : {"gripper", "arm"}) {
    if (!root.has(behind) || devices.modbus) continue;
    throw ConfigError(document.file, document.line_of(behind), "modbus", "",
                      fmt::format("missing; section {} is behind it", behind));
  }
  if (root.has("gripper")) devices.gripper = read_gripper(root.section("gripper"));
  if (root.has("arm")) devices.arm = read_axis(root.section("arm"));
  if (root.has("gyro")) {
    devices.gyro = GyroSection{read_gyro_device(root.section("gyro")), read_gyro_port(root.section("gyro"))};
  }
  if (root.has("link")) devices.link = read_link(root.section("link"), document);
  if (root.has("operator")) devices.operator_socket = root.section("operator").word("socket");
  return devices;
}

DeviceRig load_device_rig(const std::string& path) { return parse_device_rig(read_file(path), path); }

DeviceRig parse_device_rig(std::string_view text, const std::string& name) {
  const Rig rig = parse_rig(text, name);
  Document document{.file = name, .lines = {}};
  const nlohmann::json root = read_yaml(text, document);
  return read_devices(rig, Section(root), document);
}

bool is_thrower(const DeviceRig& rig) {
  return rig.drive && rig.modbus && rig.gripper && rig.arm && rig.gyro && rig.rig.near_camera && rig.rig.low_camera;
}

}  // namespace hogline::config
