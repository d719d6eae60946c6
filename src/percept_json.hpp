// Percepts as the program prints them: one JSON object a line, keys in a fixed order.
#pragma once

#include <string>
#include <vector>

#include "vision/percepts/far_look.hpp"
#include "vision/percepts/sheet_pose.hpp"
#include "vision/percepts/stones.hpp"

namespace hogline {

/// What the two teams are called.
struct TeamNames {
  std::string first = "red";
  std::string second = "yellow";
};

/// One of the two names, or unknown.
std::string team_name(Team team, const TeamNames& names);

/// One line without its newline. Where the percept is not ok every estimate is null and `reason` says why.
std::string pose_line(const std::string& image, const SheetPosePercept& percept, double elapsed_ms);

/// The same for the stones of a picture; an empty list where the percept is not ok. `handle_deg` is the grip's
/// direction from e's y axis modulo half a turn, null where it was not measured.
std::string stones_line(const std::string& image, const StonesPercept& percept, const TeamNames& names,
                        double elapsed_ms);

/// The same for a picture of the far camera, with the correction of the head's angles. A stone's sigma holds what all
/// stones of the picture share, too.
std::string far_stones_line(const std::string& image, const FarPercept& percept, const TeamNames& names,
                            double elapsed_ms);

/// A picture of a sequence in which nothing was found, and why.
struct LeftOut {
  std::string image;
  std::string reason;
};

/// The same for a robot that stands still: its pictures' stones together. `frames` of `pictures` counted.
std::string stones_sequence_line(int pictures, int frames, const std::vector<StoneSighting>& stones,
                                 const std::vector<LeftOut>& left_out, const std::string& reason,
                                 const TeamNames& names, double elapsed_ms);

}  // namespace hogline
