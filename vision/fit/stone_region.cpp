#include "vision/fit/stone_region.hpp"

#include <cmath>

namespace hogline::vision {
namespace {

constexpr float tiny = 1e-9F;

// Of the discs `d.part` of the thickness below the upper rim.
void disc_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, DiscDistances& d) {
  const auto drop = static_cast<float>(eye.z() - stone.shape.handle_height_m);
  const auto thickness = static_cast<float>(stone.shape.handle_thickness_m);
  const auto from_x = static_cast<float>(eye.x() - stone.place.x());
  const auto from_y = static_cast<float>(eye.y() - stone.place.y());
  const Pixels depth = drop + thickness * d.part;
  Pixels normal_x = from_x + depth * sights.x;
  Pixels normal_y = from_y + depth * sights.y;
  const Pixels radius = (normal_x.square() + normal_y.square()).sqrt().max(tiny);
  normal_x /= radius;
  normal_y /= radius;
  d.outward_x = depth * (sights.x_by_column * normal_x + sights.y_by_column * normal_y);
  d.outward_y = depth * (sights.x_by_row * normal_x + sights.y_by_row * normal_y);
  d.by_radius = (d.outward_x.square() + d.outward_y.square()).sqrt().max(tiny).inverse();
  d.outward_x *= d.by_radius;
  d.outward_y *= d.by_radius;
  d.px = d.by_radius * (static_cast<float>(stone.shape.handle_radius_m) - radius);
  d.by_x = d.by_radius * normal_x;
  d.by_y = d.by_radius * normal_y;
  d.by_height = d.by_x * sights.x + d.by_y * sights.y;
}

}  // namespace

void SightLines::resize(Eigen::Index count) {
  for (Pixels* p : {&x, &y, &x_by_column, &x_by_row, &y_by_column, &y_by_row}) p->resize(count);
}

// A line of sight is deepest in the cylinder where it comes nearest to the axis, or at the nearer of the two rims.
void handle_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, DiscDistances& d) {
  const auto drop = static_cast<float>(eye.z() - stone.shape.handle_height_m);
  const auto thickness = static_cast<float>(std::max(1e-4, stone.shape.handle_thickness_m));
  const auto from_x = static_cast<float>(eye.x() - stone.place.x());
  const auto from_y = static_cast<float>(eye.y() - stone.place.y());
  const Pixels square = (sights.x.square() + sights.y.square()).max(tiny);
  d.part = (-(from_x * sights.x + from_y * sights.y) / square - drop) / thickness;
  d.part = d.part.max(0.0F).min(1.0F);
  disc_distances(stone, eye, sights, d);
}

void face_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, DiscDistances& d) {
  d.part.setZero(sights.x.size());
  disc_distances(stone, eye, sights, d);
}

// In coordinates in which the ellipsoid is a ball of radius 1, the distance of the line of sight from its middle.
void body_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, BodyDistances& d) {
  const auto by_radius = static_cast<float>(1.0 / stone.shape.body_radius_m);
  const auto by_half = static_cast<float>(1.0 / stone.shape.body_half_height_m);
  const auto eye_z = static_cast<float>(eye.z());
  const float from_x = static_cast<float>(eye.x() - stone.place.x()) * by_radius;
  const float from_y = static_cast<float>(eye.y() - stone.place.y()) * by_radius;
  const float from_z = static_cast<float>(eye.z() - stone.shape.body_half_height_m) * by_half;
  const Pixels along_x = sights.x * by_radius;
  const Pixels along_y = sights.y * by_radius;
  const Pixels square = along_x.square() + along_y.square() + by_half * by_half;
  const Pixels way = (by_half * from_z - from_x * along_x - from_y * along_y) / square;  // to the nearest point
  Pixels normal_x = from_x + way * along_x;
  Pixels normal_y = from_y + way * along_y;
  d.height = from_z - way * by_half;
  const Pixels level = normal_x.square() + normal_y.square();
  const Pixels distance = (level + d.height.square()).sqrt().max(tiny);
  normal_x /= distance;
  normal_y /= distance;
  d.height /= distance;
  d.outward_x = by_radius * way * (sights.x_by_column * normal_x + sights.y_by_column * normal_y);
  d.outward_y = by_radius * way * (sights.x_by_row * normal_x + sights.y_by_row * normal_y);
  const Pixels scale = (d.outward_x.square() + d.outward_y.square()).sqrt().max(tiny).inverse();
  d.outward_x *= scale;
  d.outward_y *= scale;
  d.px = scale * (1.0F - distance);
  d.by_x = by_radius * scale * normal_x;
  d.by_y = by_radius * scale * normal_y;
  d.by_radius = by_radius * scale * level / distance;
  d.by_half_height = by_half * by_half * scale * d.height * (eye_z - way);
}

}  // namespace hogline::vision
