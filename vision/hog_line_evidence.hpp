// Is it really a hog line, and ours? Asked of the picture once the camera's pose is known: cut by cut, paint of one
// colour between ice on either side, with both its edges where 0.1016 m puts them, over most of the sheet; and the thin
// centre line where the pose puts it.
#pragma once

#include <string>

#include "vision/edges/profile.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

/// Cuts through a stretch of a line. Where the line is neither seen nor its place bare ice, something hides it: people,
/// stones, logos, lamps.
struct LineStretch {
  int looked = 0;
  int seen = 0;  ///< as such a line should be
  int bare = 0;  ///< nothing but ice
};

struct HogLineEvidence {
  LineStretch left;           ///< of the hog line, across one half of the sheet
  LineStretch right;          ///< the same of the other half
  LineStretch left_end;       ///< the outermost piece of it
  LineStretch right_end;      ///< the same of the other half
  LineStretch centre;         ///< of the centre line, outside the house
  LineStretch beyond;         ///< of the centre line, beyond the hog line
  LineStretch ring;           ///< of the outer ring's edge
  double ice_beyond = 0.0;    ///< share of the sheet beyond the hog line that looks like the ice before it
  bool house_beyond = false;  ///< rings lie behind the line: it is the other end's
};

HogLineEvidence weigh_hog_line(const Picture& picture, const ResponseCurve& response, const SheetCamera& camera);

/// Why the evidence does not speak for our hog line; empty when it does.
std::string doubt(const HogLineEvidence& evidence);

}  // namespace hogline::vision
