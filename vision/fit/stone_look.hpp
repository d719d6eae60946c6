// What all stones of a picture share, beside the rig's measures of the handle.
#pragma once

#include <Eigen/Core>

#include "vision/geometry/stone_shape.hpp"

namespace hogline::vision {

struct SharedLook {
  StoneShape shape;
  double wall_light = 0.7;      ///< of the handle's wall, as a share of its upper face's
  double blur_px = 0.75;        ///< standard deviation, of the light as a whole
  double colour_blur_px = 1.2;  ///< of colours: sensors with a mosaic and compression blur them more
};

/// Thickness, body radius, body half height, handle radius, wall, blur, colour blur. The handle's height is not
/// among them: it was measured, and a body that is no ellipsoid would pull it, and all places with it.
inline constexpr int shared_numbers = 7;

using SharedVector = Eigen::Matrix<double, shared_numbers, 1>;
using SharedMatrix = Eigen::Matrix<double, shared_numbers, shared_numbers>;

SharedVector numbers_of(const SharedLook& look);

/// The look with these numbers, each kept in its bounds; what is no number stays as in `like`.
SharedLook look_of(const SharedVector& numbers, const SharedLook& like);

}  // namespace hogline::vision
