// The CAN bus and the drives on it, by listening and by SDO uploads alone.
#pragma once

#include <optional>
#include <vector>

#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/head_config.hpp"
#include "src/doctor/finding.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

/// The bus first, then each wheel, then the head's axes, as far as there are any. On a bus of which the rig declares no
/// node, those that are heard.
std::vector<Finding> examine_drives(const std::optional<hw::TwoWheelDriveConfig>& wheels,
                                    const std::optional<hw::TwoAxisHeadConfig>& head, Site& site);

}  // namespace hogline::doctor
