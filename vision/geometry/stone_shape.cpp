#include "vision/geometry/stone_shape.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

namespace hogline::vision {

// In the plane of the line of sight: the edge's corner would be 1 from the arc's middle along both axes, the arc passes
// the line of sight at 1, and what is left between the two parallels is taken along the vertical.
double rim_lowering_m(const StoneShape& shape, double range_m, double eye_m) {
  const double down = eye_m - shape.handle_height_m;
  const double length = std::hypot(down, range_m);
  if (!(range_m > 0.0) || !(length > 0.0)) return 0.0;
  const double sine = down / length;
  const double cosine = range_m / length;
  return shape.rim_rounding_m * (sine + cosine - 1.0) / cosine;
}

Bearing bearing_of(const Eigen::Vector2d& place, const Eigen::Vector3d& camera) {
  const Eigen::Vector2d to = place - camera.head<2>();
  const double range_m = to.norm();
  const Eigen::Vector2d away = range_m > 1e-9 ? Eigen::Vector2d(to / range_m) : Eigen::Vector2d::UnitY();
  return {away, {away.y(), -away.x()}, range_m};
}

Eigen::Vector3d circle_point(const Eigen::Vector2d& place, const Bearing& bearing, double radius_m, double height_m,
                             const Turn& turn) {
  const Eigen::Vector2d p = place + radius_m * (turn.cosine * bearing.right + turn.sine * bearing.away);
  return {p.x(), p.y(), height_m};
}

// In coordinates in which the ellipsoid is a ball, its outline is the circle in which the cone of tangents touches it.
BodyOutline::BodyOutline(const Eigen::Vector2d& place, const StoneShape& shape, const Eigen::Vector3d& camera)
    : half_(shape.body_radius_m, shape.body_radius_m, shape.body_half_height_m),
      centre_(place.x(), place.y(), shape.body_half_height_m) {
  const Eigen::Vector3d eye = (camera - centre_).cwiseQuotient(half_);
  const double distance = eye.norm();
  assert(distance > 1.0);
  const Eigen::Vector3d towards = eye / distance;
  right_ = Eigen::Vector3d::UnitZ().cross(towards).normalized();
  up_ = towards.cross(right_);
  middle_ = towards / distance;
  radius_ = std::sqrt(1.0 - 1.0 / (distance * distance));
}

Eigen::Vector3d BodyOutline::at(const Turn& turn) const {
  const Eigen::Vector3d on_ball = middle_ + radius_ * (turn.cosine * right_ + turn.sine * up_);
  return centre_ + on_ball.cwiseProduct(half_);
}

Eigen::Vector3d body_outline_point(const Eigen::Vector2d& place, const StoneShape& shape, const Eigen::Vector3d& camera,
                                   const Turn& turn) {
  return BodyOutline(place, shape, camera).at(turn);
}

}  // namespace hogline::vision
