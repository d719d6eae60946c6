// Poses: `aMb` maps b-coordinates to a-coordinates; inner letters cancel (eMc = eMb * bMc).
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "vision/percepts/sheet_pose.hpp"

namespace hogline::vision {

/// A rigid motion in SE(3), metres.
using Pose = Eigen::Isometry3d;

/// A twist in ViSP's order, translation first: (vx, vy, vz, wx, wy, wz).
struct Twist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
};

/// Where a camera sits on the body. b to a camera-aligned frame by Rz(yaw) Ry(pitch) Rx(roll); pitch > 0 looks down.
struct Mount {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};

/// The camera's pose on the body: b x forward, y left, z up; c x right, y down, z forward.
Pose bMc(const Mount& mount);

/// The body's pose in e from its planar pose: b's origin on the ice, no roll, no pitch.
Pose eMb(const PlanarPose& body);

/// The planar body that carries a camera seen at `eMc`: yaw is the heading of b's x axis, (x, y) the camera's position
/// less the mount's offset turned by yaw. A pitch that differs from the mount's (a rocking body) is not blamed on the
/// position. Precondition: b's x axis is not vertical.
PlanarPose planar_body(const Pose& eMc, const Mount& mount);

/// The motion of a frame that moves with the constant twist, in its own axes, for unit time: aMb * exp(xi).
Pose exp(const Twist& twist);

/// The twist whose exponential is the motion. Precondition: the rotation is less than pi.
Twist log(const Pose& motion);

/// The 4x4 matrix row by row.
std::array<double, 16> row_major(const Pose& pose);

/// The inverse of row_major(). Precondition: the rotation part is orthonormal.
Pose from_row_major(const std::array<double, 16>& rows);

/// All 16 numbers are finite.
bool is_finite(const Pose& pose);

/// An angle brought to (-pi, pi].
double wrapped(double angle_rad);

}  // namespace hogline::vision
