// The sheet as the skip sees it, in e of the skip: the tee at the origin, y towards the thrower (World Curling, Rules
// of Curling, R1 "Sheet"), and the way between e and s.
#pragma once

#include "servo/throw_fit.hpp"

namespace hogline::servo {

inline constexpr double hog_line_m = 6.401;           ///< its house-side edge
inline constexpr double back_line_m = 1.829;          ///< behind the tee: its outer edge is at y = -1.829
inline constexpr double far_hog_line_m = 28.346;      ///< the thrower's, its house-side edge
inline constexpr double far_tee_in_sheet_m = 38.405;  ///< the skip's tee in s

/// What is known of the ice, seen from the other end: the floor falls to the other side.
inline IceEstimate from_other_end(const IceEstimate& ice) {
  IceEstimate turned = ice;
  turned.lateral_mps2 = -ice.lateral_mps2;
  for (const std::size_t i : {2u, 5u, 6u, 7u}) turned.covariance[i] = -ice.covariance[i];
  return turned;
}

/// A track seen by the skip, in s. Twice is the same track again.
inline ThrowTrack from_other_end(ThrowTrack track) {
  for (TrackLook& look : track.looks) {
    look.x_m = -look.x_m;
    look.y_m = far_tee_in_sheet_m - look.y_m;
    look.tilt.camera_x_m = -look.tilt.camera_x_m;
    look.tilt.camera_y_m = far_tee_in_sheet_m - look.tilt.camera_y_m;
  }
  return track;
}

}  // namespace hogline::servo
