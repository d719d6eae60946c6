// What the simulator knows and no controller is told.
#pragma once

#include <optional>
#include <vector>

#include "vision/percepts/sheet_pose.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::hw::sim {

/// Velocity of b's origin in b, and the rate of turn, counter-clockwise from above positive.
struct BodyTwist {
  double forward_mps = 0.0;
  double left_mps = 0.0;
  double yaw_radps = 0.0;
};

/// The stone's centre in e, on the ice.
struct StoneTruth {
  double x_m = 0.0;
  double y_m = 0.0;
  double vx_mps = 0.0;
  double vy_mps = 0.0;
  double spin_radps = 0.0;  ///< counter-clockwise from above positive
  double handle_rad = 0.0;  ///< direction of the handle from e's y axis, counter-clockwise positive
};

/// The moment the stone was free of the jaws.
struct ReleaseRecord {
  Stamp stamp{};
  double stone_x_m = 0.0;  ///< in e
  double stone_y_m = 0.0;
  double speed_mps = 0.0;    ///< of the stone, after the jaws' drag
  double heading_rad = 0.0;  ///< of the stone's velocity from e's y axis, counter-clockwise positive
  double spin_radps = 0.0;
  double hog_distance_m = 0.0;  ///< from b's origin along e's y to the hog line's house-side edge
  double yaw_rad = 0.0;         ///< of the body
};

struct Truth {
  Stamp stamp{};
  PlanarPose body;  ///< e to b
  BodyTwist twist;
  double acceleration_mps2 = 0.0;  ///< along b's x
  double pitch_rad = 0.0;          ///< of the body about its y axis: positive when it looks down
  double left_wheel_radps = 0.0;
  double right_wheel_radps = 0.0;
  bool slipping = false;  ///< a wheel turns faster or slower than it rolls
  StoneTruth stone;
  int stone_team = 0;  ///< 0 or 1: the rig's first or second
  bool held = false;
  std::vector<StoneTruth> others;  ///< stones that lay on the sheet
  std::vector<int> other_teams;    ///< theirs, in the same order
  int hits = 0;                    ///< collisions of stones so far
  std::optional<ReleaseRecord> release;
  std::optional<Stamp> set_down;  ///< when a robot that stands let the stone go, and has not gripped it again since
  std::optional<Stamp> burned;    ///< when the robot touched the stone after its release
  double arm_unfolded = 0.0;      ///< 0 folded .. 1 unfolded
};

}  // namespace hogline::hw::sim
