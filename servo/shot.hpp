// The order of a shot, as strategy gives it.
#pragma once

#include <optional>

namespace hogline::servo {

/// The sense in which the stone spins, seen from above. A stone that turns counter-clockwise curls left.
enum class Curl { clockwise, counter_clockwise };

struct ShotOrder {
  double speed_mps = 0.0;    ///< of the stone at the moment it is let go
  double heading_rad = 0.0;  ///< of the stone's velocity from e's y axis, counter-clockwise positive
  Curl curl = Curl::counter_clockwise;
  double spin_radps = 0.0;  ///< magnitude of the stone's rate of turn at release
  /// x of the stone where it is let go, in e; empty: where a line through the place leads at which the robot stands.
  std::optional<double> release_x_m{};
};

}  // namespace hogline::servo
