// Every device of a rig, one after the other, without moving any.
#pragma once

#include <vector>

#include "src/config/thrower_rig.hpp"
#include "src/doctor/finding.hpp"
#include "src/doctor/site.hpp"

namespace hogline::doctor {

std::vector<Finding> examine(const config::ThrowerRig& rig, Site& site);

}  // namespace hogline::doctor
