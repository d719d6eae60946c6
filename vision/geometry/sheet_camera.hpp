// A camera over the ice: lens, pose and refraction together, from the sheet to pixels and back.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/geometry/ice.hpp"
#include "vision/geometry/lens.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline::vision {

/// How a pixel moves. `by_pose` is by the camera's own twist (ViSP's order, translation first, in c's axes:
/// eMc becomes eMc * exp(twist)), as in ViSP's interaction matrices.
struct PaintProjection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 6> by_pose;
  Eigen::Matrix2d by_paint;  ///< d(pixel)/d(paint xy in e)
  Eigen::Vector2d by_depth;  ///< d(pixel)/d(paint_depth_m)
};

class SheetCamera {
 public:
  /// The lens is copied. Precondition: the camera is above the ice, the pose is finite.
  SheetCamera(const Lens& lens, const Pose& eMc, const Ice& ice);

  const Lens& lens() const { return lens_; }
  const Pose& eMc() const { return eMc_; }
  const Ice& ice() const { return ice_; }
  void move_to(const Pose& eMc);

  /// The pixel of a point of paint at (x, y) in e, through the ice; nothing when it can not be seen by the lens.
  std::optional<Eigen::Vector2d> project_paint(const Eigen::Vector2d& paint) const;

  /// The same with its derivatives.
  std::optional<PaintProjection> project_paint_with_jacobian(const Eigen::Vector2d& paint) const;

  /// The pixel of a point in the air, in e.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& eP) const;

  /// The point of paint that a pixel shows; nothing at or above the horizon.
  std::optional<Eigen::Vector2d> paint_at(const Eigen::Vector2d& pixel) const;

  /// The point of the horizontal plane at height z_m in e that a pixel shows (in the air, no refraction).
  std::optional<Eigen::Vector2d> plane_at(const Eigen::Vector2d& pixel, double z_m) const;

 private:
  Lens lens_;
  Pose eMc_;
  Pose cMe_;
  Ice ice_;
};

}  // namespace hogline::vision
