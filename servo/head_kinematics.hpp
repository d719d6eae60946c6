// The pan-tilt head that carries the near and far cameras: where a camera looks, and how it moves with the joints.
//
// Frame h turns with the head; at pan = tilt = 0 its axes are b's. Pan turns about b's z axis, counter-clockwise
// positive; tilt about h's y axis, positive looks down. The two axes need not meet.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "vision/percepts/sheet_pose.hpp"

namespace hogline::servo {

struct HeadAngles {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
};

/// Where the axes are, and one camera on the head.
struct HeadGeometry {
  std::array<double, 3> pan_axis_m{};   ///< a point of it, in b
  std::array<double, 3> tilt_axis_m{};  ///< from there to a point of the tilt axis, at pan = 0
  std::array<double, 3> camera_m{};     ///< from there to the optical centre, in h
  std::array<double, 9> hRc{};          ///< the camera's axes in h, row by row
};

struct HeadPose {
  Eigen::Matrix3d bRc = Eigen::Matrix3d::Identity();
  Eigen::Vector3d bPc = Eigen::Vector3d::Zero();
};

/// A point as the camera sees it: x right and y down at depth 1, and its depth.
struct SeenPoint {
  double x = 0.0;
  double y = 0.0;
  double depth_m = 0.0;
};

HeadPose camera_pose(const HeadGeometry& head, const HeadAngles& q);

/// The camera's twist in its own frame, translation first (rows), by the rates of pan and tilt (columns).
Eigen::Matrix<double, 6, 2> camera_jacobian(const HeadGeometry& head, const HeadAngles& q);

/// A point of e in the frame b of a body that stands there.
Eigen::Vector3d in_body(const Eigen::Vector3d& eP, const PlanarPose& body);

/// Nothing when the point is not in front of the camera.
std::optional<SeenPoint> seen(const HeadGeometry& head, const HeadAngles& q, const Eigen::Vector3d& bP);

/// The angles that bring a point to the optical axis; nothing when no angles do.
std::optional<HeadAngles> angles_for(const HeadGeometry& head, const Eigen::Vector3d& bP);

}  // namespace hogline::servo
