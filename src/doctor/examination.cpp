#include "src/doctor/examination.hpp"

#include <iterator>
#include <utility>

#include "src/doctor/camera_check.hpp"
#include "src/doctor/drive_check.hpp"
#include "src/doctor/gyro_check.hpp"
#include "src/doctor/modbus_check.hpp"

namespace hogline::doctor {

std::vector<Finding> examine(const config::DeviceRig& rig, Site& site) {
  std::vector<Finding> findings;
  if (rig.drive || rig.head || !rig.rig.can_interface.empty()) findings = examine_drives(rig.drive, rig.head, site);

  bool head_covered = false;
  if (rig.modbus) {
    ModbusFindings modbus = examine_modbus(rig.gripper, rig.arm, site);
    std::ranges::move(modbus.findings, std::back_inserter(findings));
    head_covered = modbus.arm_unfolded == false;
  }

  if (rig.gyro) findings.push_back(examine_gyro(site));

  for (const auto& [name, setup, on_the_arm] :
       {std::tuple("near", &rig.rig.near_camera, true), std::tuple("low", &rig.rig.low_camera, false),
        std::tuple("far", &rig.rig.far_camera, true)}) {
    if (!*setup) continue;
    findings.push_back(examine_camera(name, rig.rig.source(name), on_the_arm && head_covered, site));
  }
  return findings;
}

}  // namespace hogline::doctor
