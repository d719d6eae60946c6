#include "servo/head_kinematics.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace hogline::servo {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double least_depth_m = 0.1;

Eigen::Matrix3d about_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return (Eigen::Matrix3d() << c, -s, 0, s, c, 0, 0, 0, 1).finished();
}

Eigen::Matrix3d about_y(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return (Eigen::Matrix3d() << c, 0, s, 0, 1, 0, -s, 0, c).finished();
}

Eigen::Vector3d vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// A point of the tilt axis, in b.
Eigen::Vector3d tilt_point(const HeadGeometry& head, const HeadAngles& q) {
  return vector(head.pan_axis_m) + about_z(q.pan_rad) * vector(head.tilt_axis_m);
}

}  // namespace

HeadPose camera_pose(const HeadGeometry& head, const HeadAngles& q) {
  const Eigen::Matrix3d bRh = about_z(q.pan_rad) * about_y(q.tilt_rad);
  return {bRh * Eigen::Map<const RowMajor3>(head.hRc.data()), tilt_point(head, q) + bRh * vector(head.camera_m)};
}

Eigen::Matrix<double, 6, 2> camera_jacobian(const HeadGeometry& head, const HeadAngles& q) {
  const HeadPose pose = camera_pose(head, q);
  const Eigen::Vector3d pan_axis(0.0, 0.0, 1.0);
  const Eigen::Vector3d tilt_axis = about_z(q.pan_rad).col(1);
  Eigen::Matrix<double, 6, 2> j;
  j.col(0).head<3>() = pan_axis.cross(pose.bPc - vector(head.pan_axis_m));
  j.col(0).tail<3>() = pan_axis;
  j.col(1).head<3>() = tilt_axis.cross(pose.bPc - tilt_point(head, q));
  j.col(1).tail<3>() = tilt_axis;
  j.topRows<3>() = (pose.bRc.transpose() * j.topRows<3>()).eval();
  j.bottomRows<3>() = (pose.bRc.transpose() * j.bottomRows<3>()).eval();
  return j;
}

Eigen::Vector3d in_body(const Eigen::Vector3d& eP, const PlanarPose& body) {
  // b's x axis points along e's y axis at yaw 0.
  const double c = std::cos(body.yaw_rad), s = std::sin(body.yaw_rad);
  const double dx = eP.x() - body.x_m, dy = eP.y() - body.y_m;
  return {-s * dx + c * dy, -c * dx - s * dy, eP.z()};
}

std::optional<SeenPoint> seen(const HeadGeometry& head, const HeadAngles& q, const Eigen::Vector3d& bP) {
  const HeadPose pose = camera_pose(head, q);
  const Eigen::Vector3d cP = pose.bRc.transpose() * (bP - pose.bPc);
  if (!(cP.z() > least_depth_m)) return std::nullopt;
  return SeenPoint{cP.x() / cP.z(), cP.y() / cP.z(), cP.z()};
}

std::optional<HeadAngles> angles_for(const HeadGeometry& head, const Eigen::Vector3d& bP) {
  const Eigen::Vector3d way = bP - vector(head.pan_axis_m) - vector(head.tilt_axis_m);
  HeadAngles q{std::atan2(way.y(), way.x()), std::atan2(-way.z(), std::hypot(way.x(), way.y()))};
  for (int i = 0; i < 20; ++i) {
    const HeadPose pose = camera_pose(head, q);
    const Eigen::Vector3d cP = pose.bRc.transpose() * (bP - pose.bPc);
    // How the point moves in the camera with the joints: opposite to the camera.
    const Eigen::Matrix<double, 6, 2> j = camera_jacobian(head, q);
    Eigen::Matrix<double, 3, 2> by_joints;
    for (int k = 0; k < 2; ++k) by_joints.col(k) = -j.col(k).head<3>() - j.col(k).tail<3>().cross(cP);
    if (cP.head<2>().norm() < 1e-9 * cP.norm() && cP.z() > least_depth_m) return q;
    const Eigen::Vector2d step = -by_joints.topRows<2>().inverse() * cP.head<2>();
    if (!step.allFinite() || step.norm() > 10.0) return std::nullopt;
    q.pan_rad += step[0];
    q.tilt_rad += step[1];
  }
  return std::nullopt;
}

}  // namespace hogline::servo
