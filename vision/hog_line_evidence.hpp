// Is it really a hog line, and ours? Asked of the picture once the camera's pose is known: column by column, paint of
// one colour between ice on either side, with both its edges where 0.1016 m puts them, over most of the sheet.
#pragma once

#include <string>

#include "vision/edges/profile.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {

/// Columns of the picture across one half of the sheet. Where the line is neither seen nor its place bare ice,
/// something hides it: people, stones, logos, lamps.
struct HogLineHalf {
  int looked = 0;
  int seen = 0;  ///< as a hog line should be
  int bare = 0;  ///< nothing but ice
};

struct HogLineEvidence {
  HogLineHalf left;
  HogLineHalf right;
  bool house_beyond = false;  ///< rings lie behind the line: it is the other end's
};

HogLineEvidence weigh_hog_line(const Picture& picture, const ResponseCurve& response, const SheetCamera& camera);

/// Why the evidence does not speak for our hog line; empty when it does.
std::string doubt(const HogLineEvidence& evidence);

}  // namespace hogline::vision
