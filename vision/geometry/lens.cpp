#include "vision/geometry/lens.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

struct RadialFactor {
  double value;
  double derivative;  // with respect to r^2
};

RadialFactor brown_radial(const std::array<double, 5>& k, double r2) {
  return {1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4])), k[0] + r2 * (2.0 * k[1] + 3.0 * r2 * k[4])};
}

// theta_d / theta of Kannala-Brandt, and its derivative by theta^2.
RadialFactor kannala_radial(const std::array<double, 5>& k, double t2) {
  return {1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))),
          k[0] + t2 * (2.0 * k[1] + t2 * (3.0 * k[2] + t2 * 4.0 * k[3]))};
}

// The first radius at which r * f(r^2) stops growing, searched up to `limit`.
template <typename Radial>
double one_to_one_radius(const Radial& radial, double limit) {
  constexpr int steps = 4000;
  for (int i = 1; i <= steps; ++i) {
    const double r = limit * i / steps;
    const RadialFactor f = radial(r * r);
    if (f.value + 2.0 * r * r * f.derivative <= 1e-3) return limit * (i - 1) / steps;
  }
  return limit;
}

Eigen::Vector2d brown_distort(const std::array<double, 5>& k, const Eigen::Vector2d& n) {
  const double x = n.x();
  const double y = n.y();
  const double p1 = k[2];
  const double p2 = k[3];
  const double r2 = n.squaredNorm();
  const RadialFactor f = brown_radial(k, r2);
  return {x * f.value + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * f.value + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

Eigen::Matrix2d brown_jacobian(const std::array<double, 5>& k, const Eigen::Vector2d& n) {
  const double x = n.x();
  const double y = n.y();
  const double p1 = k[2];
  const double p2 = k[3];
  const RadialFactor f = brown_radial(k, n.squaredNorm());
  const double cross = 2.0 * x * y * f.derivative + 2.0 * p1 * x + 2.0 * p2 * y;
  Eigen::Matrix2d jacobian;
  jacobian << f.value + 2.0 * x * x * f.derivative + 2.0 * p1 * y + 6.0 * p2 * x, cross, cross,
      f.value + 2.0 * y * y * f.derivative + 6.0 * p1 * y + 2.0 * p2 * x;
  return jacobian;
}

constexpr int max_iterations = 60;
constexpr double converged = 1e-14;

// The r in [0, limit] with r * f(r^2) = target, which grows there: Newton, kept inside a shrinking bracket so that a
// strongly bent lens can not throw it over the fold. Nothing when the target lies beyond.
template <typename Radial>
std::optional<double> undistorted_radius(const Radial& radial, double target, double limit) {
  double low = 0.0;
  double high = limit;
  if (!(target <= limit * radial(limit * limit).value)) return std::nullopt;
  double r = std::min(target, limit);
  for (int i = 0; i < max_iterations; ++i) {
    const RadialFactor f = radial(r * r);
    const double error = r * f.value - target;
    if (std::abs(error) < converged * (1.0 + target)) break;
    (error > 0.0 ? high : low) = r;
    const double next = r - error / (f.value + 2.0 * r * r * f.derivative);
    r = next > low && next < high ? next : 0.5 * (low + high);
  }
  return r;
}

}  // namespace

Lens::Lens(const Intrinsics& intrinsics) : intrinsics_(intrinsics) {
  assert(intrinsics.fx_px > 0.0 && intrinsics.fy_px > 0.0 && intrinsics.width_px > 0 && intrinsics.height_px > 0);
  const auto& k = intrinsics_.distortion;
  max_radius_ = intrinsics_.model == LensModel::brown_conrady
                    ? one_to_one_radius([&k](double r2) { return brown_radial(k, r2); }, 20.0)
                    : one_to_one_radius([&k](double t2) { return kannala_radial(k, t2); }, std::numbers::pi);
}

std::optional<Eigen::Vector2d> Lens::project(const Eigen::Vector3d& cP, Jacobian* jacobian) const {
  return intrinsics_.model == LensModel::brown_conrady ? project_brown_conrady(cP, jacobian)
                                                       : project_kannala_brandt(cP, jacobian);
}

std::optional<Eigen::Vector2d> Lens::project_brown_conrady(const Eigen::Vector3d& cP, Jacobian* jacobian) const {
  if (!(cP.z() > 1e-9)) return std::nullopt;
  const Eigen::Vector2d n = cP.head<2>() / cP.z();
  if (!(n.squaredNorm() <= max_radius_ * max_radius_)) return std::nullopt;
  if (jacobian != nullptr) {
    Jacobian perspective;
    perspective << 1.0, 0.0, -n.x(), 0.0, 1.0, -n.y();
    *jacobian = Eigen::Vector2d(intrinsics_.fx_px, intrinsics_.fy_px).asDiagonal() *
                brown_jacobian(intrinsics_.distortion, n) * perspective / cP.z();
  }
  const Eigen::Vector2d distorted = brown_distort(intrinsics_.distortion, n);
  return Eigen::Vector2d(intrinsics_.cx_px + intrinsics_.fx_px * distorted.x(),
                         intrinsics_.cy_px + intrinsics_.fy_px * distorted.y());
}

std::optional<Eigen::Vector2d> Lens::project_kannala_brandt(const Eigen::Vector3d& cP, Jacobian* jacobian) const {
  const double rho = cP.head<2>().norm();
  const double range2 = cP.squaredNorm();
  if (!(range2 > 0.0) || !std::isfinite(range2)) return std::nullopt;
  const double theta = std::atan2(rho, cP.z());
  if (theta > max_radius_) return std::nullopt;
  const RadialFactor f = kannala_radial(intrinsics_.distortion, theta * theta);
  const double theta_d = theta * f.value;
  // theta_d / rho, which stays finite on the axis.
  const bool on_axis = rho < 1e-12 * std::abs(cP.z());
  if (on_axis && cP.z() <= 0.0) return std::nullopt;
  const double scale = on_axis ? 1.0 / cP.z() : theta_d / rho;
  if (jacobian != nullptr) {
    const double dtheta_d = f.value + 2.0 * theta * theta * f.derivative;
    Jacobian j = Jacobian::Zero();
    if (on_axis) {
      j(0, 0) = j(1, 1) = 1.0 / cP.z();
    } else {
      const Eigen::Vector2d u = cP.head<2>() / rho;
      j.leftCols<2>() =
          (dtheta_d * cP.z() / range2) * u * u.transpose() + scale * (Eigen::Matrix2d::Identity() - u * u.transpose());
      j.col(2) = -(dtheta_d * rho / range2) * u;
    }
    *jacobian = Eigen::Vector2d(intrinsics_.fx_px, intrinsics_.fy_px).asDiagonal() * j;
  }
  return Eigen::Vector2d(intrinsics_.cx_px + intrinsics_.fx_px * scale * cP.x(),
                         intrinsics_.cy_px + intrinsics_.fy_px * scale * cP.y());
}

std::optional<Eigen::Vector3d> Lens::ray(const Eigen::Vector2d& pixel) const {
  if (!pixel.allFinite()) return std::nullopt;
  const Eigen::Vector2d normalised((pixel.x() - intrinsics_.cx_px) / intrinsics_.fx_px,
                                   (pixel.y() - intrinsics_.cy_px) / intrinsics_.fy_px);
  return intrinsics_.model == LensModel::brown_conrady ? ray_brown_conrady(normalised) : ray_kannala_brandt(normalised);
}

std::optional<Eigen::Vector3d> Lens::ray_brown_conrady(const Eigen::Vector2d& normalised) const {
  const double radius_d = normalised.norm();
  if (radius_d < 1e-15) return Eigen::Vector3d::UnitZ();
  const auto radius =
      undistorted_radius([this](double r2) { return brown_radial(intrinsics_.distortion, r2); }, radius_d, max_radius_);
  // Tangential distortion may push a point just over the radial limit: start on it and let the check below decide.
  Eigen::Vector2d n = normalised * (radius.value_or(max_radius_) / radius_d);
  for (int i = 0; i < max_iterations; ++i) {
    const Eigen::Vector2d error = normalised - brown_distort(intrinsics_.distortion, n);
    if (error.squaredNorm() < converged * converged * (1.0 + normalised.squaredNorm())) break;
    n += brown_jacobian(intrinsics_.distortion, n).inverse() * error;
    if (!n.allFinite()) return std::nullopt;
  }
  const bool valid = n.squaredNorm() <= max_radius_ * max_radius_ &&
                     (brown_distort(intrinsics_.distortion, n) - normalised).norm() < 1e-12 * (1.0 + n.norm());
  if (!valid) return std::nullopt;
  return Eigen::Vector3d(n.x(), n.y(), 1.0);
}

std::optional<Eigen::Vector3d> Lens::ray_kannala_brandt(const Eigen::Vector2d& normalised) const {
  const double theta_d = normalised.norm();
  if (theta_d < 1e-15) return Eigen::Vector3d::UnitZ();
  const auto theta = undistorted_radius([this](double t2) { return kannala_radial(intrinsics_.distortion, t2); },
                                        theta_d, max_radius_);
  if (!theta) return std::nullopt;
  const Eigen::Vector2d u = normalised / theta_d;
  return Eigen::Vector3d(std::sin(*theta) * u.x(), std::sin(*theta) * u.y(), std::cos(*theta));
}

bool Lens::in_picture(const Eigen::Vector2d& pixel, double margin_px) const {
  return pixel.x() >= margin_px && pixel.y() >= margin_px && pixel.x() <= intrinsics_.width_px - 1 - margin_px &&
         pixel.y() <= intrinsics_.height_px - 1 - margin_px;
}

}  // namespace hogline::vision
