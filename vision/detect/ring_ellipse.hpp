// The outer ring's contour and its ellipse in the undistorted picture plane.
#pragma once

#include <optional>
#include <vector>

#include "vision/detect/edge_points.hpp"
#include "vision/detect/house_segmentation.hpp"

namespace hogline::vision {

struct RingEllipse {
  Eigen::Matrix3d conic;                 ///< n' C n = 0 for homogeneous plane points n, of unit norm
  std::vector<Eigen::Vector2d> contour;  ///< pixels of the edge points it rests on
  double residual_px = 0.0;              ///< RMS of their distances
};

/// The outermost contour of the largest connected area, made exact by the edge points beside it. The picture's border
/// and occluders lie on the contour as well: they have no edge of ice there, or fall out of the robust fit.
std::optional<RingEllipse> fit_outer_ring(const HouseSegmentation& house, const std::vector<EdgePoint>& points,
                                          double pixels_per_unit);

}  // namespace hogline::vision
