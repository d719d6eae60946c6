#include "vision/fit/fit_solver.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr double floor_sigma_px = 0.04;   // model and interpolation: no site is better than this
constexpr double shared_sigma_px = 0.02;  // what all sites of one feature can be off together
constexpr double tukey = 4.685;           // 95 % efficiency on Gaussian noise
constexpr int reweightings = 8;

// d(residual)/d(step) of a site: the predicted pixel's motion along the normal.
Vector7 row_of(const PlannedSite& site, const PaintedFeature& feature) {
  Vector7 row;
  row.head<6>() = site.by_pose.transpose();
  const double side = feature.place == PaintedFeature::Place::left_sideline    ? -0.5
                      : feature.place == PaintedFeature::Place::right_sideline ? 0.5
                                                                               : 0.0;
  row(6) = side * site.by_across_px_per_m;
  return row;
}

double site_sigma(const Measurement& m) { return std::hypot(m.sigma_px, floor_sigma_px); }

// Robust standard deviation of the normalised residuals, at least 1: agreement by chance is no proof of precision.
double robust_scale(const std::vector<Measurement>& measurements, std::vector<double>& buffer) {
  buffer.clear();
  for (const Measurement& m : measurements) buffer.push_back(std::abs(m.residual_px) / site_sigma(m));
  const auto middle = buffer.begin() + static_cast<std::ptrdiff_t>(buffer.size() / 2);
  std::nth_element(buffer.begin(), middle, buffer.end());
  return std::max(1.0, 1.4826 * *middle);
}

double tukey_weight(double normalised) {
  const double u = normalised / tukey;
  return std::abs(u) >= 1.0 ? 0.0 : (1.0 - u * u) * (1.0 - u * u);
}

// The rules bound the width; where it is not asked for, it stays where it is.
double width_information(bool free_width) {
  constexpr double rules_sigma_m = 0.2;
  return free_width ? 1.0 / (rules_sigma_m * rules_sigma_m) : 1.0;
}

struct Normal {
  Matrix7 matrix = Matrix7::Zero();
  Vector7 vector = Vector7::Zero();

  void add(const Vector7& row, double residual, double weight) {
    matrix.noalias() += weight * row * row.transpose();
    vector.noalias() += (weight * residual) * row;
  }
};

// Where e's vertical points in b says how the body leans: its x part by pitch, its y part by roll.
void add_prior(const Pose& eMc, const Mount& mount, const MountPrior& prior, Normal& normal) {
  const Eigen::Matrix3d bRc = bMc(mount).linear();
  const Eigen::Vector3d g = eMc.linear().row(2).transpose();
  const Eigen::Vector3d up = bRc * g;
  Eigen::Matrix3d G;
  G << 0.0, -g.z(), g.y(), g.z(), 0.0, -g.x(), -g.y(), g.x(), 0.0;
  const Eigen::Matrix3d by_rotation = bRc * G;
  const auto lean = [&](int axis, double sigma) {
    if (sigma <= 0.0) return;
    Vector7 row = Vector7::Zero();
    row.segment<3>(3) = by_rotation.row(axis).transpose();
    normal.add(row, -up(axis), 1.0 / (sigma * sigma));
  };
  lean(0, prior.pitch_sigma_rad);
  lean(1, prior.roll_sigma_rad);
  if (prior.height_sigma_m > 0.0) {
    Vector7 row = Vector7::Zero();
    row.head<3>() = g;
    normal.add(row, mount.z_m - eMc.translation().z(), 1.0 / (prior.height_sigma_m * prior.height_sigma_m));
  }
}

}  // namespace

Solution solve(const std::vector<PaintedFeature>& features, const std::vector<PlannedSite>& sites,
               std::vector<Measurement>& measurements, const Pose& eMc, const Mount& mount, const MountPrior& prior,
               bool free_width) {
  Solution solution;
  if (measurements.empty()) return solution;
  std::vector<double> buffer;
  buffer.reserve(measurements.size());
  std::vector<int> used(features.size(), 0);
  const auto feature_of = [&](const Measurement& m) -> const PaintedFeature& {
    return features[static_cast<std::size_t>(sites[static_cast<std::size_t>(m.site)].feature)];
  };

  double scale = 1.0;
  for (int iteration = 0; iteration < reweightings; ++iteration) {
    for (Measurement& m : measurements) {
      const PlannedSite& site = sites[static_cast<std::size_t>(m.site)];
      m.residual_px = m.offset_px - row_of(site, feature_of(m)).dot(solution.step);
    }
    scale = robust_scale(measurements, buffer);
    // The first rounds are wide, so that a start far from the answer does not throw the right sites away.
    const double widening = iteration < 3 ? 3.0 - iteration : 1.0;
    Normal normal;
    add_prior(eMc, mount, prior, normal);
    normal.matrix(6, 6) += width_information(free_width);
    for (Measurement& m : measurements) {
      const double sigma = site_sigma(m);
      m.weight = tukey_weight(m.residual_px / (widening * scale * sigma));
      Vector7 row = row_of(sites[static_cast<std::size_t>(m.site)], feature_of(m));
      if (!free_width) row(6) = 0.0;
      normal.add(row, m.offset_px, m.weight / (sigma * sigma));
    }
    const Eigen::LDLT<Matrix7> factor(normal.matrix);
    if (factor.info() != Eigen::Success || !factor.isPositive()) return solution;
    solution.step = factor.solve(normal.vector);
    if (!solution.step.allFinite()) return solution;
    solution.information = normal.matrix;
  }

  for (const Measurement& m : measurements) {
    if (m.weight > 0.1) ++used[static_cast<std::size_t>(sites[static_cast<std::size_t>(m.site)].feature)];
  }
  Normal honest;
  add_prior(eMc, mount, prior, honest);
  honest.matrix(6, 6) += width_information(free_width);
  for (const Measurement& m : measurements) {
    const PlannedSite& site = sites[static_cast<std::size_t>(m.site)];
    Vector7 row = row_of(site, feature_of(m));
    if (!free_width) row(6) = 0.0;
    const double own = scale * site_sigma(m);
    const double shared = shared_sigma_px * shared_sigma_px * used[static_cast<std::size_t>(site.feature)];
    honest.add(row, 0.0, m.weight / (own * own + shared));
  }
  const Eigen::FullPivLU<Matrix7> inverse(honest.matrix);
  if (!inverse.isInvertible()) return solution;
  solution.covariance = inverse.inverse();
  solution.scale_px = scale * floor_sigma_px;
  solution.ok = solution.covariance.allFinite();
  return solution;
}

}  // namespace hogline::vision
