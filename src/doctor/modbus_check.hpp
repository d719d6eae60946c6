// Jaws, spin belt and folding arm, by reading their input registers alone.
#pragma once

#include <optional>
#include <vector>

#include "hw/modbus/modbus_arm.hpp"
#include "hw/modbus/modbus_gripper.hpp"
#include "src/doctor/finding.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

struct ModbusFindings {
  std::vector<Finding> findings;     ///< jaws, spin belt, arm
  std::optional<bool> arm_unfolded;  ///< nothing if the arm does not say
};

/// As far as the rig has them.
ModbusFindings examine_modbus(const std::optional<hw::ModbusGripperConfig>& gripper,
                              const std::optional<hw::AxisConfig>& arm, Site& site);

}  // namespace hogline::doctor
