// Competitor for the low view: plain vpMeLine on undistorted frames, one for each line of the H; distance, direction
// and offset from where the calibrated mount puts them on the ice.
#pragma once

#include <memory>

#include "tests/bench/method.hpp"

namespace hogline::bench {

/// Follows the hog line's house-side edge, the centre line and both sidelines, where they are in view. Knows neither
/// ice nor how the body rocks.
std::unique_ptr<Method> make_visp_low_lines(const Camera& camera, double sheet_width_m);

}  // namespace hogline::bench
