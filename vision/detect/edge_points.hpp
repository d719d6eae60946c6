// Edge points of paint on ice, lens-corrected: the picture is searched as it is, only the points are undistorted.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/ground_view.hpp"

namespace hogline::vision {

struct EdgePoint {
  Eigen::Vector2d pixel;          ///< in the raw picture
  Eigen::Vector2d plane;          ///< undistorted
  Eigen::Vector2d plane_normal;   ///< unit, towards the lighter side, undistorted
  Eigen::Vector2d ground;         ///< m
  Eigen::Vector2d ground_normal;  ///< unit, towards the lighter side
};

struct EdgePointOptions {
  double range_m = 14.0;      ///< farther ice is left out
  double half_width_m = 6.0;  ///< ice farther to the side is left out
};

/// Searches the lower part of the picture at half its size in the darkest of the three colours: ice is white, so paint
/// of any colour is dark in one of them. Points stand where the gradient is largest across the edge and well above the
/// picture's own noise.
std::vector<EdgePoint> find_edge_points(const cv::Mat& image, const GroundView& view, const EdgePointOptions& options);

/// The same in a picture of the ice's light at half the size (CV_8UC1) whose first row is the raw picture's row `top`.
std::vector<EdgePoint> find_edge_points(const cv::Mat& half, int top, const GroundView& view,
                                        const EdgePointOptions& options);

}  // namespace hogline::vision
