// The skip's head follows the thrown stone: rates of pan and tilt that keep it in the middle of the far view, from the
// far hog line to rest (Yoon et al., section III.D: far view first, near view later; the head carries both).
//
// Image-based, and ahead of its own delays: what the last picture showed is carried to this moment, and on by the
// drives' lag, by the stone's estimated motion and by the joints' measured one. What body pose, mount and stone
// estimate get wrong together shows as a steady difference between picture and expectation; it is learnt and kept while
// nothing is seen. So a stone that is hidden for seconds, or handed over to the near view, is still followed.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "servo/gaze_task.hpp"
#include "servo/head_kinematics.hpp"
#include "vision/percepts/sheet_pose.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

struct HeadAxisLimits {
  double min_rad = 0.0;
  double max_rad = 0.0;
  double max_speed_radps = 0.0;
  double max_acceleration_radps2 = 0.0;
};

struct HeadAimingConfig {
  HeadGeometry head;
  HeadAxisLimits pan;
  HeadAxisLimits tilt;
  GazeGains gains{.at_zero_per_s = 5.0, .at_infinity_per_s = 3.0, .slope_per_s = 20.0};
  double limit_margin_rad = 0.005;                  ///< kept from a joint's limits
  double drive_lag_s = 0.0;                         ///< from a commanded rate to the joint's
  double aim_height_m = 0.06;                       ///< of the stone's middle above the ice
  double difference_time_s = 0.5;                   ///< in which the steady difference follows the pictures
  double greatest_difference = 0.05;                ///< at depth 1: a picture that differs more is of something else
  Duration stale = std::chrono::milliseconds(100);  ///< joints older than this move nothing
};

/// As measured.
struct HeadJoints {
  Stamp stamp{};
  HeadAngles angles;
  double pan_radps = 0.0;
  double tilt_radps = 0.0;
};

/// What the tracker says of the stone, in e.
struct GazeTarget {
  Stamp stamp{};
  double x_m = 0.0;
  double y_m = 0.0;
  double vx_mps = 0.0;
  double vy_mps = 0.0;
};

/// Where the far picture showed the stone's middle, undistorted, at depth 1.
struct GazeLook {
  Stamp stamp{};
  double x = 0.0;
  double y = 0.0;
};

struct HeadAimingCommand {
  bool ok = false;
  std::string reason;  ///< why not, when !ok; then the rates are 0
  double pan_radps = 0.0;
  double tilt_radps = 0.0;
  double off_axis_rad = 0.0;  ///< of the stone, as far as is known now
  bool limited = false;       ///< by a joint's limits, rate or acceleration
};

class HeadAiming {
 public:
  explicit HeadAiming(const HeadAimingConfig& config);

  /// Where to point before the stone comes, by the head's own smooth profile. Nothing when the place is out of reach.
  std::optional<HeadAngles> point_at(double x_m, double y_m, const PlanarPose& body) const;

  /// A picture of the stone, however late up to a second. Looks older than all known joints, and such as differ too
  /// much from what was expected, are left out (false).
  bool look(const GazeLook& look, const GazeTarget& target_then, const PlanarPose& body);

  /// One control period. `target`: the tracker's estimate for `now`.
  HeadAimingCommand step(Stamp now, Duration dt, const HeadJoints& joints, const GazeTarget& target,
                         const PlanarPose& body);

 private:
  SeenPoint expected(const HeadAngles& q, const GazeTarget& target, double ahead_s, const PlanarPose& body) const;
  std::optional<HeadAngles> joints_at(Stamp stamp) const;
  double limited(double rate, double before, double angle, const HeadAxisLimits& limits, double dt_s) const;
  HeadAimingCommand refused(std::string reason);

  HeadAimingConfig config_;
  GazeTask task_;
  std::deque<HeadJoints> joints_;
  Eigen::Vector2d difference_ = Eigen::Vector2d::Zero();
  std::optional<Stamp> last_look_;
  double pan_radps_ = 0.0;  ///< as commanded last
  double tilt_radps_ = 0.0;
};

}  // namespace hogline::servo
