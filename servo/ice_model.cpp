#include "servo/ice_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace hogline::servo {
namespace {

using Covariance = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Map<Covariance> covariance_of(IceEstimate& estimate) {
  return Eigen::Map<Covariance>(estimate.covariance.data());
}
Eigen::Map<const Covariance> covariance_of(const IceEstimate& estimate) {
  return Eigen::Map<const Covariance>(estimate.covariance.data());
}

IceEstimate untouched(const IceModelConfig& config) {
  IceEstimate estimate{1.0, config.curl_mean, 0.0, {}, 0};
  covariance_of(estimate).diagonal() << std::pow(config.friction_sigma, 2), std::pow(config.curl_sigma, 2),
      std::pow(config.lateral_sigma_mps2, 2);
  return estimate;
}

}  // namespace

IceModel::IceModel(const IceModelConfig& config, const ThrowFitConfig& fit)
    : IceModel(config, untouched(config), fit) {}

IceModel::IceModel(const IceModelConfig& config, const IceEstimate& saved, const ThrowFitConfig& fit)
    : config_(config), fit_(fit), estimate_(saved) {
  assert(!refusal(saved));
}

ThrowFit IceModel::learn(const ThrowTrack& track) {
  IceEstimate prior = estimate_;
  if (prior.throws > 0) {
    covariance_of(prior).diagonal() += Eigen::Vector3d(
        std::pow(config_.friction_drift, 2), std::pow(config_.curl_drift, 2), std::pow(config_.lateral_drift_mps2, 2));
  }
  ThrowFit fit = fit_throw(track, prior, fit_);
  if (fit.ok) estimate_ = fit.learnt;
  return fit;
}

Eigen::Matrix3d IceModel::throw_covariance() const {
  Eigen::Matrix3d covariance = covariance_of(estimate_);
  covariance(0, 0) += std::pow(estimate_.friction_scale * fit_.throw_friction_sigma, 2);
  return covariance;
}

std::optional<std::string> refusal(const IceEstimate& estimate) {
  const auto within = [](double value, double least, double greatest) { return value >= least && value <= greatest; };
  if (!within(estimate.friction_scale, 0.3, 3.0)) return "friction_scale must be between 0.3 and 3";
  if (!within(estimate.curl_gain, -1.0, 5.0)) return "curl_gain must be between -1 and 5";
  if (!within(estimate.lateral_mps2, -0.01, 0.01)) return "lateral_mps2 must be between -0.01 and 0.01";
  if (estimate.throws < 0) return "throws must not be negative";
  const auto covariance = covariance_of(estimate);
  if (!covariance.allFinite()) return "covariance must be finite";
  const Eigen::Vector3d sigma = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (sigma.minCoeff() <= 0.0) return "covariance must have a positive diagonal";
  const Eigen::Matrix3d correlation =
      sigma.cwiseInverse().asDiagonal() * covariance * sigma.cwiseInverse().asDiagonal();
  if (!correlation.isApprox(correlation.transpose(), 1e-6)) return "covariance must be symmetric";
  if (correlation.llt().info() != Eigen::Success) return "covariance must be positive definite";
  return std::nullopt;
}

StopPrediction predict_stop(const SlidingStone& stone, const IceFactors& ice,
                            const Eigen::Matrix<double, 7, 7>& covariance) {
  const Rest rest = rest_of(stone, ice);
  const Eigen::Matrix2d c = rest.by_start * covariance * rest.by_start.transpose();
  return {rest.x_m, rest.y_m, rest.after_s, {c(0, 0), c(0, 1), c(1, 1)}};
}

}  // namespace hogline::servo
