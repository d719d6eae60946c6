#include "servo/heading_filter.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace hogline::servo {
namespace {

constexpr auto history_span = std::chrono::milliseconds(500);
constexpr double gate_sigma = 4.0;

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

HeadingModel::State unknown_heading(const GyroConfig& config) {
  HeadingModel::State state;
  state.yaw_yaw = std::numbers::pi * std::numbers::pi;
  state.bias_bias = config.bias_sigma_radps * config.bias_sigma_radps;
  return state;
}

}  // namespace

void HeadingModel::propagate(State& state, double dt_s, double rate_radps, bool at_rest) const {
  const double drift = config_.bias_drift_radps_per_sqrt_s * config_.bias_drift_radps_per_sqrt_s;
  if (!at_rest) {
    const double walk = config_.noise_rad_per_sqrt_s * config_.noise_rad_per_sqrt_s;
    state.yaw_rad = wrapped(state.yaw_rad + (rate_radps - state.bias_radps) * dt_s);
    state.yaw_yaw += (-2.0 * state.yaw_bias + state.bias_bias * dt_s) * dt_s + walk * dt_s;
    state.yaw_bias -= state.bias_bias * dt_s;
  }
  state.bias_bias += drift * dt_s;
}

void HeadingModel::hold(State& state, double dt_s) const { propagate(state, dt_s, state.rate_radps, state.at_rest); }

void HeadingModel::drive(State& state, double dt_s, const Input& input) const {
  propagate(state, dt_s, (state.rate_radps + input.rate_radps) / 2.0, input.at_rest);
  state.rate_radps = input.rate_radps;
  state.at_rest = input.at_rest;
  if (!input.at_rest || dt_s <= 0.0) return;
  // A body at rest: the sample is the bias, with the white noise of its interval.
  const double noise = config_.noise_rad_per_sqrt_s * config_.noise_rad_per_sqrt_s / dt_s;
  const double innovation = input.rate_radps - state.bias_radps;
  const double variance = state.bias_bias + noise;
  const double yaw_gain = state.yaw_bias / variance;
  const double bias_gain = state.bias_bias / variance;
  state.yaw_rad = wrapped(state.yaw_rad + yaw_gain * innovation);
  state.bias_radps += bias_gain * innovation;
  state.yaw_yaw -= yaw_gain * state.yaw_bias;
  state.yaw_bias -= yaw_gain * state.bias_bias;
  state.bias_bias -= bias_gain * state.bias_bias;
}

bool HeadingModel::correct(State& state, const Measurement& measurement) const {
  const double innovation = wrapped(measurement.yaw_rad - state.yaw_rad);
  const double look_variance = measurement.sigma_rad * measurement.sigma_rad;
  if (innovation * innovation > gate_sigma * gate_sigma * (state.yaw_yaw + look_variance)) return false;
  const double variance = state.yaw_yaw + look_variance / measurement.counts_as;
  const double yaw_gain = state.yaw_yaw / variance;
  const double bias_gain = state.yaw_bias / variance;
  state.yaw_rad = wrapped(state.yaw_rad + yaw_gain * innovation);
  state.bias_radps += bias_gain * innovation;
  state.bias_bias -= bias_gain * state.yaw_bias;
  state.yaw_bias -= bias_gain * state.yaw_yaw;
  state.yaw_yaw -= yaw_gain * state.yaw_yaw;
  return true;
}

HeadingFilter::HeadingFilter(const GyroConfig& config, Stamp start)
    : fusion_(HeadingModel(config), history_span, start, unknown_heading(config)) {}

void HeadingFilter::gyro(Stamp stamp, double rate_radps, bool at_rest) { fusion_.input(stamp, {rate_radps, at_rest}); }

void HeadingFilter::start(Stamp stamp, double yaw_rad, double sigma_rad) {
  HeadingModel::State state = fusion_.at(stamp);
  state.yaw_rad = wrapped(yaw_rad);
  state.yaw_yaw = sigma_rad * sigma_rad;
  state.yaw_bias = 0.0;
  fusion_.restart(stamp, state);
  started_ = true;
}

Fusion HeadingFilter::sheet_yaw(Stamp stamp, double yaw_rad, double sigma_rad, double counts_as) {
  assert(started_ && std::isfinite(yaw_rad) && sigma_rad > 0.0 && counts_as > 0.0);
  const Fusion fusion = fusion_.measure(stamp, {yaw_rad, sigma_rad, counts_as});
  if (fusion == Fusion::accepted) gated_in_a_row_ = 0;
  if (fusion == Fusion::gated) ++gated_, ++gated_in_a_row_;
  return fusion;
}

HeadingEstimate HeadingFilter::at(Stamp stamp) const {
  const HeadingModel::State state = fusion_.at(stamp);
  return {state.yaw_rad, std::sqrt(state.yaw_yaw), state.rate_radps - state.bias_radps, state.bias_radps,
          std::sqrt(state.bias_bias)};
}

}  // namespace hogline::servo
