// What happened during a throw, sample by sample: truth, belief and orders side by side.
#pragma once

#include <string>
#include <vector>

#include "servo/thrower.hpp"

namespace hogline {

struct ThrowSample {
  double t_s = 0.0;  ///< since the start of the throw
  servo::ThrowerState state = servo::ThrowerState::unfold;
  PlanarPose true_body;
  double true_speed_mps = 0.0;
  double true_hog_distance_m = 0.0;
  double stone_x_m = 0.0;
  double stone_y_m = 0.0;
  bool stone_held = true;
  double believed_yaw_rad = 0.0;
  double believed_hog_distance_m = 0.0;
  double believed_speed_mps = 0.0;
  double speed_setpoint_mps = 0.0;
};

struct ThrowLog {
  std::vector<ThrowSample> samples;

  /// Writes the samples as CSV with a header line; angles in degrees. Throws std::runtime_error when it can not.
  void write_csv(const std::string& path) const;
};

}  // namespace hogline
