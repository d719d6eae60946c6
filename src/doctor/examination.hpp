// Every device of a rig, one after the other, without moving any.
#pragma once

#include <vector>

#include "src/config/device_rig.hpp"
#include "src/doctor/finding.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

/// Those that the rig declares.
std::vector<Finding> examine(const config::DeviceRig& rig, Site& site);

}  // namespace hogline::doctor
