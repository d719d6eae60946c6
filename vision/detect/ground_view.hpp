// The ice as the mount alone predicts it: pixels, the undistorted picture plane, and metres on the ice in front of the
// body. Good to centimetres near by; the body's tilt and the paint's depth are left to the fit.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vision/camera_setup.hpp"

namespace hogline::vision {

/// Plane coordinates n are the undistorted picture's: (x/z, y/z) in c. Ground coordinates g are metres on the ice,
/// x to the right of the body and y ahead of it, from b's origin.
class GroundView {
 public:
  explicit GroundView(const CameraSetup& setup);

  /// The plane point of a pixel, interpolated in a table (within 0.02 px); nothing outside the lens model's range.
  std::optional<Eigen::Vector2d> plane(const Eigen::Vector2d& pixel) const;
  /// Nothing at or above the horizon.
  std::optional<Eigen::Vector2d> ground_of_plane(const Eigen::Vector2d& n) const;
  std::optional<Eigen::Vector2d> plane_of_ground(const Eigen::Vector2d& g) const;
  std::optional<Eigen::Vector2d> pixel_of_plane(const Eigen::Vector2d& n) const;
  std::optional<Eigen::Vector2d> pixel_of_ground(const Eigen::Vector2d& g) const;

  /// The first picture row, from the top, in which ice nearer than `range_m` can lie.
  int first_row(double range_m) const;

  const CameraSetup& setup() const { return setup_; }
  const Lens& lens() const { return lens_; }
  /// The camera's pose in g (a body at the origin, at yaw 0).
  const Pose& gMc() const { return gMc_; }
  double pixels_per_plane_unit() const { return setup_.intrinsics.fx_px; }

 private:
  static constexpr int cell_px = 8;

  CameraSetup setup_;
  Lens lens_;
  Pose gMc_;
  int columns_;
  int rows_;
  std::vector<Eigen::Vector2d> table_;  ///< NaN where the lens sees nothing
};

}  // namespace hogline::vision
