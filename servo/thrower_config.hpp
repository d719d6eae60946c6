// The numbers the thrower's controller needs, all from the rig file. No defaults: each is set or the rig is refused.
#pragma once

#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

/// The two-wheeled base.
struct BaseGeometry {
  double wheel_radius_m = 0.0;
  double track_m = 0.0;  ///< between the wheels' contact points
};

struct MotionLimits {
  double max_speed_mps = 0.0;
  double max_acceleration_mps2 = 0.0;
  double max_jerk_mps3 = 0.0;
  double max_deceleration_mps2 = 0.0;  ///< after the release
  double max_yaw_rate_radps = 0.0;
  double max_yaw_acceleration_radps2 = 0.0;
};

/// Where and how the stone is let go.
struct ReleaseConfig {
  double hog_distance_m = 0.0;   ///< of b's origin when the stone shall leave the jaws
  double tolerance_m = 0.0;      ///< outside release plane +- tolerance the stone is kept
  double stone_x_m = 0.0;        ///< the held stone's centre in b, ahead of the origin
  double gripper_delay_s = 0.0;  ///< from the command to the stone being free
};

/// How old an input may be before the robot stops.
struct AgeLimits {
  Duration wheels{};
  Duration gyro{};
  Duration gripper{};
  Duration arm{};
  Duration near_view{};  ///< while measuring and aligning
  Duration low_view{};   ///< while the low view is the source of the distance
};

struct ThrowerConfig {
  BaseGeometry base;
  MotionLimits limits;
  ReleaseConfig release;
  AgeLimits ages;
};

}  // namespace hogline::servo
