#include "vision/fit/stone_region.hpp"

#include <algorithm>
#include <type_traits>

namespace hogline::vision {
namespace {

constexpr float tiny = 1e-9F;

/// Nearest to the axis of the discs of a wall, or its upper face alone.
enum class Plate { wall, face };

void set_count(Pixels& px, Eigen::Index count) { px.resize(count); }

void set_count(DiscDistances& d, Eigen::Index count) {
  for (Pixels* p : {&d.px, &d.outward_x, &d.outward_y, &d.by_x, &d.by_y, &d.by_height, &d.by_radius, &d.part}) {
    p->resize(count);
  }
}

void set_count(BodyDistances& d, Eigen::Index count) {
  for (Pixels* p : {&d.px, &d.outward_x, &d.outward_y, &d.by_x, &d.by_y, &d.by_radius, &d.by_half_height, &d.height}) {
    p->resize(count);
  }
}

Pixels& px_of(Pixels& px) { return px; }
Pixels& px_of(DiscDistances& d) { return d.px; }
Pixels& px_of(BodyDistances& d) { return d.px; }

// Distances are all there is to know, or, as plain pixels, those alone.
//
// A line of sight is deepest in the cylinder where it comes nearest to the axis, or at the nearer of the two rims.
template <Plate plate, typename Distances>
void disc_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, Distances& d) {
  const auto drop = static_cast<float>(eye.z() - stone.shape.handle_height_m);
  const auto thickness = static_cast<float>(stone.shape.handle_thickness_m);
  const auto some_thickness = static_cast<float>(std::max(1e-4, stone.shape.handle_thickness_m));
  const auto from_x = static_cast<float>(eye.x() - stone.place.x());
  const auto from_y = static_cast<float>(eye.y() - stone.place.y());
  const auto handle_radius = static_cast<float>(stone.shape.handle_radius_m);
  set_count(d, sights.x.size());
  for (Eigen::Index i = 0; i < sights.x.size(); i += 4) {
    const Four x = four(sights.x, i);
    const Four y = four(sights.y, i);
    Four part = Four::Zero();
    if constexpr (plate == Plate::wall) {
      const Four square = (x.square() + y.square()).max(tiny);
      part = ((-(from_x * x + from_y * y) / square - drop) / some_thickness).max(0.0F).min(1.0F);
    }
    const Four depth = drop + thickness * part;
    Four normal_x = from_x + depth * x;
    Four normal_y = from_y + depth * y;
    const Four radius = (normal_x.square() + normal_y.square()).sqrt().max(tiny);
    normal_x /= radius;
    normal_y /= radius;
    const Four outward_x = depth * (four(sights.x_by_column, i) * normal_x + four(sights.y_by_column, i) * normal_y);
    const Four outward_y = depth * (four(sights.x_by_row, i) * normal_x + four(sights.y_by_row, i) * normal_y);
    const Four scale = (outward_x.square() + outward_y.square()).sqrt().max(tiny).inverse();
    four(px_of(d), i) = scale * (handle_radius - radius);
    if constexpr (!std::is_same_v<Distances, Pixels>) {
      const Four by_x = scale * normal_x;
      const Four by_y = scale * normal_y;
      four(d.part, i) = part;
      four(d.outward_x, i) = outward_x * scale;
      four(d.outward_y, i) = outward_y * scale;
      four(d.by_x, i) = by_x;
      four(d.by_y, i) = by_y;
      four(d.by_height, i) = by_x * x + by_y * y;
      four(d.by_radius, i) = scale;
    }
  }
}

// In coordinates in which the ellipsoid is a ball of radius 1, the distance of the line of sight from its middle.
template <typename Distances>
void ball_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, Distances& d) {
  const auto by_radius = static_cast<float>(1.0 / stone.shape.body_radius_m);
  const auto by_half = static_cast<float>(1.0 / stone.shape.body_half_height_m);
  const auto eye_z = static_cast<float>(eye.z());
  const float from_x = static_cast<float>(eye.x() - stone.place.x()) * by_radius;
  const float from_y = static_cast<float>(eye.y() - stone.place.y()) * by_radius;
  const float from_z = static_cast<float>(eye.z() - stone.shape.body_half_height_m) * by_half;
  set_count(d, sights.x.size());
  for (Eigen::Index i = 0; i < sights.x.size(); i += 4) {
    const Four along_x = four(sights.x, i) * by_radius;
    const Four along_y = four(sights.y, i) * by_radius;
    const Four square = along_x.square() + along_y.square() + by_half * by_half;
    const Four way = (by_half * from_z - from_x * along_x - from_y * along_y) / square;  // to the nearest point
    Four normal_x = from_x + way * along_x;
    Four normal_y = from_y + way * along_y;
    Four height = from_z - way * by_half;
    const Four level = normal_x.square() + normal_y.square();
    const Four distance = (level + height.square()).sqrt().max(tiny);
    normal_x /= distance;
    normal_y /= distance;
    const Four outward_x =
        by_radius * way * (four(sights.x_by_column, i) * normal_x + four(sights.y_by_column, i) * normal_y);
    const Four outward_y =
        by_radius * way * (four(sights.x_by_row, i) * normal_x + four(sights.y_by_row, i) * normal_y);
    const Four scale = (outward_x.square() + outward_y.square()).sqrt().max(tiny).inverse();
    four(px_of(d), i) = scale * (1.0F - distance);
    if constexpr (!std::is_same_v<Distances, Pixels>) {
      height /= distance;
      four(d.height, i) = height;
      four(d.outward_x, i) = outward_x * scale;
      four(d.outward_y, i) = outward_y * scale;
      four(d.by_x, i) = by_radius * scale * normal_x;
      four(d.by_y, i) = by_radius * scale * normal_y;
      four(d.by_radius, i) = by_radius * scale * level / distance;
      four(d.by_half_height, i) = by_half * by_half * scale * height * (eye_z - way);
    }
  }
}

}  // namespace

void SightLines::resize(Eigen::Index count) {
  for (Pixels* p : {&x, &y, &x_by_column, &x_by_row, &y_by_column, &y_by_row}) p->resize(count);
}

void handle_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, DiscDistances& d) {
  disc_distances<Plate::wall>(stone, eye, sights, d);
}

void face_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, DiscDistances& d) {
  disc_distances<Plate::face>(stone, eye, sights, d);
}

void body_distances(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, BodyDistances& d) {
  ball_distances(stone, eye, sights, d);
}

void handle_px(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, Pixels& px) {
  disc_distances<Plate::wall>(stone, eye, sights, px);
}

void body_px(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& sights, Pixels& px) {
  ball_distances(stone, eye, sights, px);
}

}  // namespace hogline::vision
