// Competitor: the near-view chain of Yoon, Kim, Hong and Sull ("Vision System of Curling Robots: Thrower and Skip",
// section III.A) in plain OpenCV calls.
#pragma once

#include <memory>

#include "tests/bench/method.hpp"

namespace hogline::bench {

/// Undistorts the whole picture; Canny and HoughLines at 1 px and 0.25 degrees; classes by slope and intercept for a
/// robot that stands before its house; k-means into three colours inside the best three lines; the outer ring's contour
/// and ellipse; four tangency points; EPnP for every (h, l, r), the least reprojection error wins. Knows neither ice
/// nor response curve, and needs both sidelines.
std::unique_ptr<Method> make_hough_chain(const Camera& camera);

}  // namespace hogline::bench
