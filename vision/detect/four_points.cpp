#include "vision/detect/four_points.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

struct Chord {
  Eigen::Vector2d a;
  Eigen::Vector2d b;
};

// Where a line cuts the conic.
std::optional<Chord> cut(const Eigen::Matrix3d& conic, const Eigen::Vector3d& line) {
  const double length = line.head<2>().norm();
  if (!(length > 1e-12)) return std::nullopt;
  const Eigen::Vector2d normal = line.head<2>() / length;
  const Eigen::Vector2d foot = -line.z() / length * normal;
  const Eigen::Vector3d p(foot.x(), foot.y(), 1.0);
  const Eigen::Vector3d d(-normal.y(), normal.x(), 0.0);
  const double qa = d.dot(conic * d);
  const double qb = d.dot(conic * p);
  const double qc = p.dot(conic * p);
  const double discriminant = qb * qb - qa * qc;
  if (!(discriminant > 0.0) || std::abs(qa) < 1e-15) return std::nullopt;
  const double root = std::sqrt(discriminant);
  return Chord{foot + (-qb + root) / qa * d.head<2>(), foot + (-qb - root) / qa * d.head<2>()};
}

}  // namespace

std::optional<FourPoints> four_points(const Eigen::Matrix3d& conic, const Eigen::Vector3d& hog,
                                      const Eigen::Vector3d& left, const Eigen::Vector3d& right) {
  const Eigen::Vector3d down_ice = left.cross(right);
  const Eigen::Vector3d t_line = conic * down_ice;  // the polar of the vanishing point joins the points of contact
  const auto sides = cut(conic, t_line);
  if (!sides) return std::nullopt;
  const Eigen::Vector3d across = t_line.cross(hog);
  const auto ends = cut(conic, conic * across);
  if (!ends) return std::nullopt;

  const bool a_is_right = sides->a.x() > sides->b.x();
  const bool a_is_far = ends->a.y() < ends->b.y();  // the picture's y grows towards the robot
  const double R = rules::outer_ring_radius_m;
  FourPoints points{{a_is_right ? sides->a : sides->b, a_is_right ? sides->b : sides->a, a_is_far ? ends->a : ends->b,
                     a_is_far ? ends->b : ends->a},
                    {{{R, 0.0}, {-R, 0.0}, {0.0, R}, {0.0, -R}}}};
  for (const auto& p : points.plane) {
    if (!p.allFinite()) return std::nullopt;
  }
  return points;
}

}  // namespace hogline::vision
