#include "servo/hog_distance_filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace hogline::servo {
namespace {

constexpr auto history_span = std::chrono::milliseconds(500);
constexpr double gate_sigma = 4.0;
constexpr double standstill_mps = 0.02;

// Of the alpha-beta filter at 200 Hz: it looks back over about 60 ms.
constexpr double speed_gain = 0.2;
constexpr double acceleration_gain_per_s = 4.0;
constexpr double jump_mps = 0.5;                  // no body does that in a control period
constexpr double acceleration_sigma_mps2 = 0.15;  // what lag and the encoders' noise leave
constexpr double encoder_sigma_mps = 0.003;

// Of the mean of normalised innovations: each look counts for so much, and alone they stay within the limit.
constexpr double surprise_share = 0.2;
constexpr double surprise_limit = 1.2;  // 3.6 standard deviations

constexpr int insisting_looks = 5;
constexpr double longest_slip_m = 0.15;  // what wheels can have lost before it is noticed

constexpr double slip_share = 0.2;     // of the way that spinning wheels measure
constexpr double scale_doubt = 0.015;  // of the odometry's scale after a slip

HogDistanceModel::State placed(const OdometryConfig& config, double hog_distance_m, double sigma_m) {
  HogDistanceModel::State state;
  state.hog_distance_m = hog_distance_m;
  const Eigen::Vector3d sigmas(sigma_m, config.scale_sigma, config.creep_sigma_s2pm);
  state.covariance = sigmas.cwiseAbs2().asDiagonal();
  return state;
}

}  // namespace

double HogDistanceModel::State::pulled_scale_variance() const {
  const Eigen::Vector2d part(1.0, -acceleration_mps2);
  return part.dot(covariance.bottomRightCorner<2, 2>() * part);
}

void HogDistanceModel::propagate(State& state, double travelled_m) const {
  const double length_m = std::abs(travelled_m);
  state.hog_distance_m -= state.pulled_scale() * travelled_m;
  Eigen::Matrix3d step = Eigen::Matrix3d::Identity();
  step(0, 1) = -travelled_m;
  step(0, 2) = state.acceleration_mps2 * travelled_m;
  state.covariance = step * state.covariance * step.transpose();
  state.covariance(0, 0) += config_.noise_m_per_sqrt_m * config_.noise_m_per_sqrt_m * length_m;
  state.covariance(1, 1) += config_.scale_drift_per_sqrt_m * config_.scale_drift_per_sqrt_m * length_m;
}

void HogDistanceModel::hold(State& state, double dt_s) const {
  const double gained_mps = state.acceleration_mps2 * dt_s;
  propagate(state, (state.odometry_mps + 0.5 * gained_mps) * dt_s);
  state.odometry_mps += gained_mps;
  state.speed_mps += gained_mps;
}

void HogDistanceModel::drive(State& state, double dt_s, const Input& input) const {
  propagate(state, (state.odometry_mps + input.odometry_mps) / 2.0 * dt_s);
  if (input.slipping) {
    const double lost_m = slip_share * state.odometry_mps * dt_s;
    auto& covariance = state.covariance;
    covariance(0, 0) += 2.0 * std::sqrt(covariance(0, 0)) * std::abs(lost_m) + lost_m * lost_m;
    covariance.row(0).tail<2>().setZero();
    covariance.col(0).tail<2>().setZero();
  }
  // Until it was noticed the slip has been taken for the wheels' scale.
  if (input.slipping && !state.slipping) state.covariance(1, 1) += scale_doubt * scale_doubt;
  state.slipping = input.slipping;
  state.odometry_mps = input.odometry_mps;
  state.speed_mps += state.acceleration_mps2 * dt_s;
  const double off_mps = input.odometry_mps - state.speed_mps;
  if (std::abs(off_mps) > jump_mps) {
    state.speed_mps = input.odometry_mps;
    state.acceleration_mps2 = 0.0;
    return;
  }
  state.speed_mps += speed_gain * off_mps;
  state.acceleration_mps2 += acceleration_gain_per_s * off_mps;
}

// Looks that agree with each other, and not with what is believed: one that errs alone is not followed by its like.
bool HogDistanceModel::insisted_on(State& state, double innovation, double sigma_m) {
  const bool agrees = std::abs(innovation - state.refused_by_m) <= gate_sigma * std::numbers::sqrt2 * sigma_m;
  state.refused = state.refused > 0 && agrees ? state.refused + 1 : 1;
  state.refused_by_m = innovation;
  return state.refused >= insisting_looks && std::abs(innovation) <= longest_slip_m;
}

bool HogDistanceModel::correct(State& state, const Measurement& measurement) const {
  const double innovation = measurement.hog_distance_m - state.hog_distance_m;
  const double look_variance = measurement.sigma_m * measurement.sigma_m;
  const double normalised = innovation / std::sqrt(state.covariance(0, 0) + look_variance);
  const bool refused = std::abs(normalised) > gate_sigma;
  if (refused && !insisted_on(state, innovation, measurement.sigma_m)) return false;
  state.surprise += surprise_share * (normalised - state.surprise);
  if (refused) state.covariance(1, 1) += scale_doubt * scale_doubt;
  if (refused || std::abs(state.surprise) > surprise_limit) {
    state.covariance(0, 0) += innovation * innovation;
    state.surprise = 0.0;
  }
  state.refused = 0;
  const double told_before = look_variance / (state.covariance(0, 0) + look_variance);
  const double worth = 1.0 / (1.0 + (1.0 / measurement.counts_as - 1.0) * told_before);
  const double variance = state.covariance(0, 0) + look_variance / worth;
  const Eigen::Vector3d gain = state.covariance.col(0) / variance;
  state.hog_distance_m += gain(0) * innovation;
  state.scale += gain(1) * innovation;
  state.creep_s2pm += gain(2) * innovation;
  state.covariance -= (gain * state.covariance.row(0)).eval();
  state.covariance = (0.5 * (state.covariance + state.covariance.transpose())).eval();
  return true;
}

HogDistanceFilter::HogDistanceFilter(const OdometryConfig& config, Stamp start, double hog_distance_m, double sigma_m)
    : model_(config), fusion_(model_, history_span, start, placed(config, hog_distance_m, sigma_m)) {
  assert(std::isfinite(hog_distance_m) && sigma_m > 0.0);
}

void HogDistanceFilter::odometry(Stamp stamp, double forward_mps, double yaw_rad, bool slipping) {
  fusion_.input(stamp, {forward_mps * std::cos(yaw_rad), slipping});
}

Fusion HogDistanceFilter::hog_distance(Stamp stamp, double hog_distance_m, double sigma_m, double counts_as) {
  assert(std::isfinite(hog_distance_m) && sigma_m > 0.0 && counts_as > 0.0);
  const Fusion fusion = fusion_.measure(stamp, {hog_distance_m, sigma_m, counts_as});
  if (fusion == Fusion::accepted) gated_in_a_row_ = 0;
  if (fusion == Fusion::gated) ++gated_, ++gated_in_a_row_;
  return fusion;
}

HogDistanceEstimate HogDistanceFilter::at(Stamp stamp) const {
  const HogDistanceModel::State state = fusion_.at(stamp);
  const double scale = state.pulled_scale();
  const double scale_sigma = std::sqrt(std::max(0.0, state.pulled_scale_variance()));
  return {state.hog_distance_m,
          std::sqrt(state.covariance(0, 0)),
          scale * state.speed_mps,
          std::hypot(state.speed_mps * scale_sigma, encoder_sigma_mps),
          scale * state.acceleration_mps2,
          acceleration_sigma_mps2,
          scale,
          scale_sigma};
}

std::optional<Crossing> HogDistanceFilter::crossing(Stamp now, double plane_hog_distance_m) const {
  HogDistanceModel::State state = fusion_.at(now);
  const double speed_mps = state.pulled_scale() * state.speed_mps;
  const double acceleration_mps2 = state.pulled_scale() * state.acceleration_mps2;
  if (speed_mps < standstill_mps) return std::nullopt;
  const double ahead_m = state.hog_distance_m - plane_hog_distance_m;
  const double there_squared = speed_mps * speed_mps + 2.0 * acceleration_mps2 * ahead_m;
  if (there_squared < standstill_mps * standstill_mps) return std::nullopt;
  const double there_mps = std::sqrt(there_squared);
  const double ahead_s = 2.0 * ahead_m / (speed_mps + there_mps);
  state.odometry_mps = state.speed_mps;
  model_.hold(state, ahead_s);
  const double sigma_m = std::sqrt(state.covariance(0, 0));
  const double driven_sigma_m =
      std::hypot(encoder_sigma_mps * ahead_s, 0.5 * acceleration_sigma_mps2 * ahead_s * ahead_s);
  return Crossing{now + from_seconds(ahead_s), std::hypot(sigma_m, driven_sigma_m) / there_mps, sigma_m};
}

}  // namespace hogline::servo
