// The findings as a table with advice for people, and as one JSON object for machines.
#pragma once

#include <string>
#include <vector>

#include "src/doctor/finding.hpp"

namespace hogline::doctor {

/// One line a device, then what is wrong or worth knowing, with what to do next.
std::string table(const std::vector<Finding>& findings);

/// {"ok", "rig", "simulated", "devices": [{"device", "line", "verdict", "found", "values", "remarks"}]} on one line.
std::string json_line(const std::vector<Finding>& findings, const std::string& rig, bool simulated);

}  // namespace hogline::doctor
