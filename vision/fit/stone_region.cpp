#include "vision/fit/stone_region.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr double tiny = 1e-9;

// A level disc `part` of the thickness below the upper rim.
RegionDistance disc_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLine& sight, double part) {
  const double drop = eye.z() - stone.shape.handle_height_m + part * stone.shape.handle_thickness_m;
  const Eigen::Vector2d from_axis = eye.head<2>() + drop * sight.slope - stone.place;
  const double radius = std::max(tiny, from_axis.norm());
  const Eigen::Vector2d normal = from_axis / radius;
  const Eigen::Vector2d gradient = drop * sight.by_pixel.transpose() * normal;
  const double scale = 1.0 / std::max(tiny, gradient.norm());
  RegionDistance d;
  d.px = scale * (stone.shape.handle_radius_m - radius);
  d.outward = scale * gradient;
  const double by_drop = scale * normal.dot(sight.slope);
  d.by << scale * normal, -part * by_drop, 0.0, 0.0, by_drop, scale;
  return d;
}

}  // namespace

// The union of three level discs, at the upper rim, half way down and at the lower rim: within 2 mm of the cylinder for
// any view from above.
RegionDistance handle_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLine& sight) {
  RegionDistance best = disc_distance(stone, eye, sight, 0.0);
  for (const double part : {0.5, 1.0}) {
    const RegionDistance d = disc_distance(stone, eye, sight, part);
    if (d.px > best.px) best = d;
  }
  return best;
}

RegionDistance face_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLine& sight) {
  return disc_distance(stone, eye, sight, 0.0);
}

// In coordinates in which the ellipsoid is a ball of radius 1, the distance of the line of sight from its middle.
RegionDistance body_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLine& sight) {
  const double radius = stone.shape.body_radius_m;
  const double half = stone.shape.body_half_height_m;
  const Eigen::Vector3d scale(1.0 / radius, 1.0 / radius, 1.0 / half);
  const Eigen::Vector3d from =
      Eigen::Vector3d(eye.x() - stone.place.x(), eye.y() - stone.place.y(), eye.z() - half).cwiseProduct(scale);
  const Eigen::Vector3d along = Eigen::Vector3d(sight.slope.x(), sight.slope.y(), -1.0).cwiseProduct(scale);
  const double way = -from.dot(along) / along.squaredNorm();  // to the nearest point
  const Eigen::Vector3d nearest = from + way * along;
  const double distance = std::max(tiny, nearest.norm());
  const Eigen::Vector3d normal = nearest / distance;
  const Eigen::Vector2d gradient = way * sight.by_pixel.transpose() * (normal.head<2>() / radius);
  const double px_per_unit = 1.0 / std::max(tiny, gradient.norm());

  RegionDistance d;
  d.px = px_per_unit * (1.0 - distance);
  d.outward = px_per_unit * gradient;
  d.by << px_per_unit * normal.x() / radius, px_per_unit * normal.y() / radius, 0.0,
      px_per_unit * nearest.head<2>().squaredNorm() / (distance * radius),
      px_per_unit * normal.z() * (eye.z() - way) / (half * half), 0.0, 0.0;
  d.height = normal.z();
  return d;
}

}  // namespace hogline::vision
