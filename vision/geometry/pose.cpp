#include "vision/geometry/pose.hpp"

#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

// b's forward, left, up axes become the camera's forward, left, up: columns are c's right, down, forward.
const Eigen::Matrix3d& body_axes_from_optical() {
  static const Eigen::Matrix3d axes = (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished();
  return axes;
}

// The left Jacobian of SO(3): its product with the linear part of a twist is the translation of its exponential.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& w) {
  const double a2 = w.squaredNorm();
  const double angle = std::sqrt(a2);
  const Eigen::Matrix3d W = skew(w);
  // 1 - cos and a - sin lose their digits below about 1e-2: the series is exact to 1e-17 there.
  const bool small = angle < 1e-2;
  const double half_sine = std::sin(0.5 * angle);
  const double first = small ? 0.5 - a2 / 24.0 + a2 * a2 / 720.0 : 2.0 * half_sine * half_sine / a2;
  const double second = small ? 1.0 / 6.0 - a2 / 120.0 + a2 * a2 / 5040.0 : (angle - std::sin(angle)) / (a2 * angle);
  return Eigen::Matrix3d::Identity() + first * W + second * W * W;
}

}  // namespace

Pose bMc(const Mount& mount) {
  Pose pose = Pose::Identity();
  pose.translation() << mount.x_m, mount.y_m, mount.z_m;
  pose.linear() = (Eigen::AngleAxisd(mount.yaw_rad, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(mount.pitch_rad, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(mount.roll_rad, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix() *
                  body_axes_from_optical();
  return pose;
}

Pose eMb(const PlanarPose& body) {
  Pose pose = Pose::Identity();
  pose.translation() << body.x_m, body.y_m, 0.0;
  pose.linear() = Eigen::AngleAxisd(body.yaw_rad + std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

PlanarPose planar_body(const Pose& eMc, const Mount& mount) {
  const Eigen::Matrix3d eRb = eMc.linear() * bMc(mount).linear().transpose();
  const double yaw_rad = std::atan2(-eRb(0, 0), eRb(1, 0));
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  return {eMc.translation().x() - (-s * mount.x_m - c * mount.y_m),
          eMc.translation().y() - (c * mount.x_m - s * mount.y_m), yaw_rad};
}

Pose exp(const Twist& twist) {
  Pose motion = Pose::Identity();
  const double angle = twist.angular.norm();
  if (angle > 0.0) motion.linear() = Eigen::AngleAxisd(angle, twist.angular / angle).toRotationMatrix();
  motion.translation() = left_jacobian(twist.angular) * twist.linear;
  return motion;
}

Twist log(const Pose& motion) {
  const Eigen::AngleAxisd rotation(motion.linear());
  const Eigen::Vector3d angular = rotation.angle() * rotation.axis();
  return {left_jacobian(angular).inverse() * motion.translation(), angular};
}

std::array<double, 16> row_major(const Pose& pose) {
  std::array<double, 16> rows{};
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) rows[static_cast<std::size_t>(4 * r + c)] = pose.matrix()(r, c);
  }
  return rows;
}

Pose from_row_major(const std::array<double, 16>& rows) {
  Pose pose = Pose::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) pose.matrix()(r, c) = rows[static_cast<std::size_t>(4 * r + c)];
  }
  return pose;
}

bool is_finite(const Pose& pose) { return pose.matrix().allFinite(); }

double wrapped(double angle_rad) {
  const double turn = 2.0 * std::numbers::pi;
  const double angle = std::remainder(angle_rad, turn);
  return angle <= -std::numbers::pi ? angle + turn : angle;
}

}  // namespace hogline::vision
