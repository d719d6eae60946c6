// Line candidates by a Hough transform of the undistorted edge points, each voting only near its gradient's direction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "vision/detect/edge_points.hpp"

namespace hogline::vision {

/// normal . n = rho in the undistorted picture plane; fitted to its supporters. A thin line's two edges give its
/// middle.
struct LineCandidate {
  Eigen::Vector2d normal;
  double rho = 0.0;
  int votes = 0;
  Eigen::Vector2d begin;  ///< where its supporters begin and end (5 % left out at both), on the line
  Eigen::Vector2d end;
  Eigen::Vector3d homogeneous() const { return {normal.x(), normal.y(), -rho}; }
};

/// The strongest first, at most `most`. `pixels_per_unit` is the picture's resolution in the plane.
std::vector<LineCandidate> find_line_candidates(const std::vector<EdgePoint>& points, double pixels_per_unit,
                                                std::size_t most);

}  // namespace hogline::vision
