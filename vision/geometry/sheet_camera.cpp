#include "vision/geometry/sheet_camera.hpp"

#include <cassert>
#include <cmath>

namespace hogline::vision {
namespace {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace

SheetCamera::SheetCamera(const Lens& lens, const Pose& eMc, const Ice& ice) : lens_(lens), ice_(ice) { move_to(eMc); }

void SheetCamera::move_to(const Pose& eMc) {
  assert(is_finite(eMc) && eMc.translation().z() > 0.0);
  eMc_ = eMc;
  cMe_ = eMc.inverse();
}

std::optional<Eigen::Vector2d> SheetCamera::project_paint(const Eigen::Vector2d& paint) const {
  const SurfacePoint s = surface_point(paint, eMc_.translation(), ice_);
  return project({s.xy.x(), s.xy.y(), 0.0});
}

std::optional<PaintProjection> SheetCamera::project_paint_with_jacobian(const Eigen::Vector2d& paint) const {
  const SurfacePoint s = surface_point(paint, eMc_.translation(), ice_);
  const Eigen::Vector3d cS = cMe_ * Eigen::Vector3d(s.xy.x(), s.xy.y(), 0.0);
  Lens::Jacobian by_point;
  const auto pixel = lens_.project(cS, &by_point);
  if (!pixel) return std::nullopt;

  const Eigen::Matrix3d eRc = eMc_.linear();
  Eigen::Matrix3d by_camera = -Eigen::Matrix3d::Identity();  // of (surface point - camera), in e
  by_camera.topRows<2>() += s.by_camera;
  Eigen::Matrix<double, 3, 6> cS_by_pose;
  cS_by_pose.leftCols<3>() = eRc.transpose() * by_camera * eRc;
  cS_by_pose.rightCols<3>() = skew(cS);

  const Eigen::Matrix<double, 2, 2> by_surface = by_point * eRc.transpose().leftCols<2>();
  return PaintProjection{*pixel, by_point * cS_by_pose, by_surface * s.by_paint, by_surface * s.by_depth};
}

std::optional<Eigen::Vector2d> SheetCamera::project(const Eigen::Vector3d& eP) const {
  return lens_.project(cMe_ * eP);
}

std::optional<Eigen::Vector2d> SheetCamera::paint_at(const Eigen::Vector2d& pixel) const {
  const auto surface = plane_at(pixel, 0.0);
  if (!surface) return std::nullopt;
  return paint_under(*surface, eMc_.translation(), ice_);
}

std::optional<Eigen::Vector2d> SheetCamera::plane_at(const Eigen::Vector2d& pixel, double z_m) const {
  const auto ray = lens_.ray(pixel);
  if (!ray) return std::nullopt;
  const Eigen::Vector3d direction = eMc_.linear() * *ray;
  const Eigen::Vector3d camera = eMc_.translation();
  if (!(direction.z() < -1e-9 * direction.norm()) || camera.z() <= z_m) return std::nullopt;
  const double range = (z_m - camera.z()) / direction.z();
  return Eigen::Vector2d(camera.head<2>() + range * direction.head<2>());
}

}  // namespace hogline::vision
