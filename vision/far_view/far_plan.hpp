// Where the far camera is thought to be before its picture is seen.
#pragma once

#include <optional>

#include "vision/geometry/pose.hpp"

namespace hogline::vision {

/// How wrong it may be is one standard deviation each.
struct FarPlan {
  Pose eMc = Pose::Identity();          ///< from body, head angles and mount
  double place_sigma_m = 0.005;         ///< of the camera, along and across the sheet: the near view's
  double height_sigma_m = 0.003;        ///< as calibrated
  double pan_sigma_rad = 0.0052;        ///< 0.3 deg: the near view's yaw, joint, head against mount
  double tilt_sigma_rad = 0.0052;       ///< 0.3 deg
  double roll_sigma_rad = 0.0035;       ///< 0.2 deg
  std::optional<double> sheet_width_m;  ///< between the sidelines, where the near view measured it
  double sheet_width_sigma_m = 0.01;
};

}  // namespace hogline::vision
