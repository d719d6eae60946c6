// Whose a stone is: by the hue of its handle against white ice.
#pragma once

#include <array>

#include "vision/percepts/stones.hpp"

namespace hogline::vision {

/// What the two teams' handles look like: hues on the colour circle, red 0, yellow 60, green 120, blue 240 degrees.
struct TeamHues {
  double first_rad = 0.0;
  double second_rad = 0.82;  ///< 47 degrees, the yellow of handles
};

struct TeamVerdict {
  Team team = Team::unknown;
  double confidence = 0.0;
};

/// `colour` is the handle's against white ice: red, green, blue. The nearer of the two hues, unless it is not near, or
/// the handle has no colour.
TeamVerdict team_of(const std::array<float, 3>& colour, const TeamHues& hues);

/// The hue alone could be one of the teams': a pixel is noisier than a handle.
bool has_a_teams_hue(const std::array<float, 3>& colour, const TeamHues& hues);

}  // namespace hogline::vision
