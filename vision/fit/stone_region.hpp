// How far inside a stone's image pixels lie, and how that moves with the stone: handle plate and body apart. Of many
// pixels at once.
#pragma once

#include <Eigen/Core>

#include "vision/geometry/stone_shape.hpp"

namespace hogline::vision {

inline constexpr int most_pixels = 512;  ///< a multiple of four

/// One number for each pixel of a stone. Nothing is allocated.
using Pixels = Eigen::Array<float, Eigen::Dynamic, 1, Eigen::ColMajor, most_pixels, 1>;

/// Four of them at once, from a multiple of four on. Beyond the last one there is room, and nothing of meaning.
using Four = Eigen::Array4f;
inline Eigen::Map<const Four, Eigen::Aligned16> four(const Pixels& p, Eigen::Index i) {
  return Eigen::Map<const Four, Eigen::Aligned16>(p.data() + i);
}
inline Eigen::Map<Four, Eigen::Aligned16> four(Pixels& p, Eigen::Index i) {
  return Eigen::Map<Four, Eigen::Aligned16>(p.data() + i);
}

/// Pixels' lines of sight in e, scaled to descend by one metre: (x, y, -1); and how they turn from pixel to pixel.
struct SightLines {
  Pixels x, y;                   ///< metres across the ice per metre of descent
  Pixels x_by_column, x_by_row;  ///< per pixel
  Pixels y_by_column, y_by_row;

  void resize(Eigen::Index count);
};

/// What a stone's image depends on. The place is the stone's own, the rest is common to all stones of a club.
struct StonePlace {
  Eigen::Vector2d place;  ///< in e, m
  StoneShape shape;
};

/// Signed distances in pixels, positive inside, of a level disc or of a range of them, with derivatives per metre.
struct DiscDistances {
  Pixels px;
  Pixels outward_x, outward_y;  ///< unit, in the picture
  Pixels by_x, by_y;            ///< by the place
  Pixels by_height, by_radius;
  Pixels part;  ///< how far down the wall, 0..1 of the thickness: the derivative by it is -part * by_height
};

/// The same of the body.
struct BodyDistances {
  Pixels px;
  Pixels outward_x, outward_y;
  Pixels by_x, by_y;
  Pixels by_radius, by_half_height;
  Pixels height;  ///< of the outline's point next to the pixel: -1 the foot, 0 the waist, 1 the top
};

/// `eye` is the camera in e. The handle's plate is an upright cylinder: its face at the top, its wall below.
void handle_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, DiscDistances& d);
void face_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, DiscDistances& d);
void body_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, BodyDistances& d);

/// The distances alone.
void handle_px(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, Pixels& px);
void body_px(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, Pixels& px);

}  // namespace hogline::vision
