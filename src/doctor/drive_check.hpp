// The CAN bus and the drives on it, by listening and by SDO uploads alone.
#pragma once

#include <vector>

#include "hw/canopen/drive_config.hpp"
#include "src/doctor/finding.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

/// The bus first, then each wheel.
std::vector<Finding> examine_drives(const hw::TwoWheelDriveConfig& config, Site& site);

}  // namespace hogline::doctor
