// The four points of Yoon, Kim, Hong and Sull ("Vision System of Curling Robots: Thrower and Skip", figure 4): where
// the tangents from the two vanishing points touch the outer ring.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace hogline::vision {

/// Plane points of the ring's rightmost, leftmost, farthest and nearest point, and where they are in e.
struct FourPoints {
  std::array<Eigen::Vector2d, 4> plane;
  std::array<Eigen::Vector2d, 4> sheet;  ///< (R, 0), (-R, 0), (0, R), (0, -R)
};

/// Lines and conic are homogeneous, in the undistorted picture plane. The down-ice vanishing point is left x right; its
/// tangents touch the ring at its right and left end, whose chord (the t-line) meets the hog line in the vanishing
/// point across; that one's tangents touch it at its far and near end. Nothing where a vanishing point lies in the
/// ring.
std::optional<FourPoints> four_points(const Eigen::Matrix3d& conic, const Eigen::Vector3d& hog,
                                      const Eigen::Vector3d& left, const Eigen::Vector3d& right);

}  // namespace hogline::vision
