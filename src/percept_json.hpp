// Percepts as the program prints them: one JSON object a line, keys in a fixed order.
#pragma once

#include <string>

#include "vision/percepts/sheet_pose.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline {

/// red, yellow or unknown.
const char* team_name(Team team);

/// One line without its newline. Where the percept is not ok every estimate is null and `reason` says why.
std::string pose_line(const std::string& image, const SheetPosePercept& percept, double elapsed_ms);

/// The same for the stones of a picture; an empty list where the percept is not ok.
std::string stones_line(const std::string& image, const StonesPercept& percept, double elapsed_ms);

}  // namespace hogline
