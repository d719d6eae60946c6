// The ice as the calibrated mount alone puts it in the undistorted picture: how a method that only knows roughly where
// the robot stands turns pixels into metres ahead of it.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/core/matx.hpp>
#include <optional>

#include "vision/geometry/pose.hpp"

namespace hogline::vision::plain {

/// A line on the ice, from b's origin. `slope_rad` is its direction from straight ahead (along) or from straight to the
/// right (across), counter-clockwise positive; `intercept_m` how far it passes ahead (across) or to the right (along).
struct GroundLine {
  bool across = false;
  double slope_rad = 0.0;
  double intercept_m = 0.0;
};

class FlatGround {
 public:
  FlatGround(const Mount& mount, const cv::Matx33d& K) {
    // g: x to the right of the body, y ahead of it.
    Pose bMg = Pose::Identity();
    bMg.linear() << 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
    const Pose cMg = bMc(mount).inverse() * bMg;
    Eigen::Matrix3d k;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) k(r, c) = K(r, c);
    }
    Eigen::Matrix3d plane;
    plane << cMg.linear().col(0), cMg.linear().col(1), cMg.translation();
    pixel_of_ground_ = k * plane;
    ground_of_pixel_ = pixel_of_ground_.inverse();
    horizon_ = ground_of_pixel_.row(2).transpose();
    if (horizon_.y() < 0.0) horizon_ = -horizon_;
  }

  /// Nothing behind the camera.
  std::optional<Eigen::Vector2d> pixel(const Eigen::Vector2d& ground) const {
    const Eigen::Vector3d p = pixel_of_ground_ * ground.homogeneous();
    if (!(p.z() > 0.0)) return std::nullopt;
    return p.hnormalized();
  }

  /// Nothing at or above the horizon.
  std::optional<Eigen::Vector2d> ground(const Eigen::Vector2d& pixel) const {
    if (!(horizon_.dot(pixel.homogeneous()) > 0.0)) return std::nullopt;
    return (ground_of_pixel_ * pixel.homogeneous()).hnormalized();
  }

  /// A homogeneous line in pixels, on the ice.
  GroundLine line(const Eigen::Vector3d& pixels) const {
    Eigen::Vector3d g = pixel_of_ground_.transpose() * pixels;
    g /= g.head<2>().norm();
    GroundLine line;
    line.across = std::abs(g.y()) > std::abs(g.x());
    const double along_normal = line.across ? g.y() : g.x();
    if (along_normal < 0.0) g = -g;
    line.slope_rad = line.across ? std::atan2(-g.x(), g.y()) : std::atan2(g.y(), g.x());
    line.intercept_m = -g.z();
    return line;
  }

  /// The first row of the picture, from the top, in which ice nearer than `range_m` lies straight ahead.
  int first_row(double range_m) const { return std::max(0, static_cast<int>(pixel({0.0, range_m})->y())); }

 private:
  Eigen::Matrix3d pixel_of_ground_;
  Eigen::Matrix3d ground_of_pixel_;
  Eigen::Vector3d horizon_;  ///< positive on pixels that show ice
};

}  // namespace hogline::vision::plain
