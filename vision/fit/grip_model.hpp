// What a stone's grip covers in the picture: a level bar over the handle's plate, and the neck it stands on.
#pragma once

#include <Eigen/Core>

#include "vision/fit/stone_region.hpp"

namespace hogline::vision {

/// Heights over the plate's upper rim. Makers differ; these are about the middle.
struct GripShape {
  double half_length_m = 0.075;
  double half_width_m = 0.014;
  double bottom_m = 0.035;  ///< of the bar
  double top_m = 0.059;
};

/// Pixels near a grip, by where their lines of sight pass the level of the bar's upper face.
struct GripSights {
  Pixels x, y;               ///< from the stone's axis, in e, m
  Eigen::Matrix2f by_pixel;  ///< of (x, y): by column, by row
  Eigen::Vector2f away;      ///< metres across the ice per metre of descent
};

/// One way in which a grip may stand.
struct GripStance {
  float turn_rad = 0.0F;   ///< of the bar from e's y axis, counter-clockwise; the neck is at its other end
  float neck_m = -0.055F;  ///< along the bar
  float raised_m = 0.0F;   ///< of bar and shape's heights
  float longer_m = 0.0F;   ///< of half the bar
};

/// Shares of each pixel, blurred.
struct GripCover {
  Pixels top;   ///< by the bar's upper face
  Pixels side;  ///< by what stands upright: the bar's sides and the neck
};

void cover_by_grip(const GripSights& sights, const GripShape& shape, const GripStance& stance, float blur_px,
                   GripCover& cover);

}  // namespace hogline::vision
