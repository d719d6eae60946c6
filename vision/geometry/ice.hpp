// Refraction through the ice. Paint lies a few millimetres under the surface (z = 0 is the surface) and, seen at a
// grazing angle, appears nearer: measured 23 mm at 8 m from a 2 m camera, 39 mm at 3 m from a 0.5 m camera for 8 mm of
// ice. Stones stand on the surface and are not affected.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace hogline::vision {

struct Ice {
  double paint_depth_m = 0.0;       ///< of the paint under the surface, >= 0
  double refractive_index = 1.309;  ///< of ice at 589 nm
};

/// Where on the surface the light from a point of paint leaves the ice towards the camera, and how that moves.
struct SurfacePoint {
  Eigen::Vector2d xy;                     ///< on z = 0
  Eigen::Matrix2d by_paint;               ///< d(xy)/d(paint xy)
  Eigen::Matrix<double, 2, 3> by_camera;  ///< d(xy)/d(camera position)
  Eigen::Vector2d by_depth;               ///< d(xy)/d(paint_depth_m)
};

/// Snell's law from paint to camera, to 1e-12 m. Precondition: the camera is above the surface (z > 0).
SurfacePoint surface_point(const Eigen::Vector2d& paint, const Eigen::Vector3d& camera, const Ice& ice);

/// The point of paint under the place `surface` on z = 0, seen from the camera: the inverse of surface_point().
Eigen::Vector2d paint_under(const Eigen::Vector2d& surface, const Eigen::Vector3d& camera, const Ice& ice);

}  // namespace hogline::vision
