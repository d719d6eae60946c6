// How far inside a stone's image a pixel lies, and how that moves with the stone: handle plate and body apart.
#pragma once

#include <Eigen/Core>

#include "vision/geometry/stone_shape.hpp"

namespace hogline::vision {

/// A pixel's line of sight in e, scaled to descend by one metre: (x, y, -1); and how it turns from pixel to pixel.
struct SightLine {
  Eigen::Vector2d slope;     ///< metres across the ice per metre of descent
  Eigen::Matrix2d by_pixel;  ///< d(slope)/d(pixel)
};

/// What a stone's image depends on. The first two are the stone's own, the rest is common to all stones of a club.
struct StonePlace {
  Eigen::Vector2d place;  ///< in e, m
  StoneShape shape;
};

/// Signed distance in pixels, positive inside, with its derivatives per metre: by the place (x, y), the handle's
/// thickness, the body's radius and half height, the handle's height and radius.
struct RegionDistance {
  double px = 0.0;
  Eigen::Vector2d outward = Eigen::Vector2d::Zero();  ///< unit, in the picture
  Eigen::Matrix<double, 7, 1> by = Eigen::Matrix<double, 7, 1>::Zero();
  double height = 0.0;  ///< where on the outline: for the body the sine of its elevation, -1 at the foot, 1 at the top
};

/// Of the handle's plate: a disc with its upper rim at the known radius and height, and as thick as the shape says.
RegionDistance handle_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLine& sight);

/// Of the plate's upper face alone: its wall is seen below it, in another light.
RegionDistance face_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLine& sight);

/// Of the body. Precondition: the eye is outside it.
RegionDistance body_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLine& sight);

}  // namespace hogline::vision
