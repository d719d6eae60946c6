#include "vision/geometry/ice.hpp"

#include <cassert>
#include <cmath>

namespace hogline::vision {
namespace {

// tan of the angle in the ice for tan u of the angle in the air, and its derivative by u.
struct Refracted {
  double tangent;
  double derivative;
};

Refracted refract(double u, double index) {
  const double one_u2 = 1.0 + u * u;
  const double sine = u / std::sqrt(one_u2) / index;
  const double cosine2 = 1.0 - sine * sine;
  const double cosine = std::sqrt(cosine2);
  return {sine / cosine, 1.0 / (one_u2 * std::sqrt(one_u2) * index * cosine2 * cosine)};
}

}  // namespace

SurfacePoint surface_point(const Eigen::Vector2d& paint, const Eigen::Vector3d& camera, const Ice& ice) {
  assert(camera.z() > 0.0);
  const double h = camera.z();
  const double d = ice.paint_depth_m;
  const Eigen::Vector2d offset = paint - camera.head<2>();
  const double R = offset.norm();
  if (R < 1e-9) {
    const double share = h / (h + d / ice.refractive_index);
    SurfacePoint below{camera.head<2>() + share * offset, share * Eigen::Matrix2d::Identity(), {}, {}};
    below.by_camera.setZero();
    below.by_camera.leftCols<2>() = (1.0 - share) * Eigen::Matrix2d::Identity();
    below.by_depth.setZero();
    return below;
  }

  // r + d tan(theta_ice(r / h)) = R, monotone and nearly linear in r: Newton from a thin layer's answer.
  double r = R * h / (h + d);
  Refracted t{};
  for (int i = 0; i < 20; ++i) {
    t = refract(r / h, ice.refractive_index);
    const double step = (r + d * t.tangent - R) / (1.0 + d * t.derivative / h);
    r -= step;
    // What a step leaves is of its square: after one this small the rest is below 1e-15.
    if (std::abs(step) < 1e-8 * (1.0 + R)) break;
  }
  t = refract(r / h, ice.refractive_index);

  const double slope = 1.0 + d * t.derivative / h;
  const Eigen::Vector2d u = offset / R;
  const Eigen::Matrix2d along = u * u.transpose();
  SurfacePoint s;
  s.xy = camera.head<2>() + r * u;
  s.by_paint = along / slope + (r / R) * (Eigen::Matrix2d::Identity() - along);
  s.by_camera.leftCols<2>() = Eigen::Matrix2d::Identity() - s.by_paint;
  s.by_camera.col(2) = (d * t.derivative * r / (h * h) / slope) * u;
  s.by_depth = (-t.tangent / slope) * u;
  return s;
}

Eigen::Vector2d paint_under(const Eigen::Vector2d& surface, const Eigen::Vector3d& camera, const Ice& ice) {
  const Eigen::Vector2d offset = surface - camera.head<2>();
  const double r = offset.norm();
  if (r < 1e-12) return surface;
  const Refracted t = refract(r / camera.z(), ice.refractive_index);
  return surface + (ice.paint_depth_m * t.tangent / r) * offset;
}

}  // namespace hogline::vision
