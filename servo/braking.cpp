#include "servo/braking.hpp"

#include <algorithm>

namespace hogline::servo {

double braking_mps2(double speed_mps, double hog_distance_m, const ReleaseConfig& release, const MotionLimits& limits) {
  const double least = std::min(least_braking_mps2, limits.max_deceleration_mps2);
  const double left_m = hog_distance_m - release.rest_hog_distance_m;
  if (!(left_m > 0.0)) return limits.max_deceleration_mps2;
  return std::clamp(speed_mps * speed_mps / (2.0 * left_m), least, limits.max_deceleration_mps2);
}

}  // namespace hogline::servo
