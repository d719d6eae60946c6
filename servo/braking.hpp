// After the release: to rest at the configured place, harder than the ice brakes the stone, within the limits.
#pragma once

#include "servo/thrower_config.hpp"

namespace hogline::servo {

/// The ice takes 0.07 m/s2 from a stone at 2 m/s and 0.38 m/s2 just before it rests (FCV1): a body that brakes with
/// this falls behind at once and never catches up.
inline constexpr double least_braking_mps2 = 0.4;

/// Deceleration of this moment, positive. A place that can not be reached within the limits is overrun, or not reached.
double braking_mps2(double speed_mps, double hog_distance_m, const ReleaseConfig& release, const MotionLimits& limits);

}  // namespace hogline::servo
