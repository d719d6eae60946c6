// Competitor: the low view of Yoon, Kim, Hong and Sull ("Vision System of Curling Robots: Thrower and Skip", section
// III.B) in plain OpenCV calls, every frame by itself.
#pragma once

#include <memory>

#include "tests/bench/method.hpp"

namespace hogline::bench {

/// Undistorts the whole picture; Canny and HoughLinesP; candidates by slope with the calibrated tilt and height; the H
/// with the least sum of the two gaps at the hog line's ends and of the difference between the intercepts' spacing and
/// the sheet's width, which it is told. Needs both sidelines; knows neither ice nor how the body rocks.
std::unique_ptr<Method> make_low_hough_chain(const Camera& camera, double sheet_width_m);

}  // namespace hogline::bench
