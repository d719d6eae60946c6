// The places of body, arm and jaws, to see whether anything moved.
#pragma once

#include <cmath>

#include "hw/sim/truth.hpp"

namespace hogline::faults {

/// What can move, and must not.
struct Posture {
  PlanarPose body;
  double arm = 0.0;
  bool held = false;

  static Posture of(const hw::sim::Truth& truth) {
    return {.body = truth.body, .arm = truth.arm_unfolded, .held = truth.held};
  }
  /// By more than a body settles: 2 mm, 2 mrad.
  bool differs(const Posture& other) const {
    constexpr double moved_m = 0.002;
    const double way_m = std::hypot(body.x_m - other.body.x_m, body.y_m - other.body.y_m);
    return way_m > moved_m || std::abs(body.yaw_rad - other.body.yaw_rad) > moved_m ||
           std::abs(arm - other.arm) > 1e-6 || held != other.held;
  }
};

}  // namespace hogline::faults
