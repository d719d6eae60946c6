#include "servo/line_tracking.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace hogline::servo {
namespace {

constexpr double gate_sigma = 4.0;
// The heading loop s^2 + k s + c k^2 with c = 0.15: damping 1.3 at every speed.
constexpr double integral_part = 0.15;
// Below this speed the curvature is not learnt: it would stand for something else.
constexpr double learning_speed_mps = 0.2;
constexpr double max_curvature_per_m = 0.05;
// The offset is let be from this many heading time constants before the release, fading over as many again.
constexpr double heading_first_constants = 2.5;

}  // namespace

double ShotLine::lateral_m(double at_x_m, double at_y_m) const {
  return -std::cos(heading_rad) * (at_x_m - x_m) - std::sin(heading_rad) * (at_y_m - y_m);
}

double ShotLine::x_at_m(double at_y_m, double lateral) const {
  return x_m - (lateral + std::sin(heading_rad) * (at_y_m - y_m)) / std::cos(heading_rad);
}

LateralFilter::LateralFilter(const ShotLine& line, const OdometryConfig& config, double lateral_m, double sigma_m)
    : line_(line), config_(config), lateral_m_(lateral_m), variance_m2_(sigma_m * sigma_m) {}

void LateralFilter::advance(double speed_mps, double heading_rad, double heading_sigma_rad, double dt_s) {
  const double travelled_m = std::abs(speed_mps) * dt_s;
  lateral_m_ += speed_mps * dt_s * std::sin(heading_rad - line_.heading_rad);
  // A heading error lasts: its share of the sigma grows with the distance, not with the distance's root.
  const double sigma_m = std::sqrt(variance_m2_) + travelled_m * heading_sigma_rad;
  variance_m2_ = sigma_m * sigma_m + config_.noise_m_per_sqrt_m * config_.noise_m_per_sqrt_m * travelled_m;
}

bool LateralFilter::correct(const SheetPosePercept& pose) {
  assert(pose.ok && pose.sigma.x_m > 0.0);
  const double innovation = line_.lateral_m(pose.body.x_m, pose.body.y_m) - lateral_m_;
  const double across = pose.sigma.x_m * std::cos(line_.heading_rad);
  const double along = pose.sigma.y_m * std::sin(line_.heading_rad);
  const double variance = variance_m2_ + across * across + along * along;
  if (innovation * innovation > gate_sigma * gate_sigma * variance) return false;
  const double gain = variance_m2_ / variance;
  lateral_m_ += gain * innovation;
  variance_m2_ -= gain * variance_m2_;
  return true;
}

LineTracking::LineTracking(const RunConfig& config, const MotionLimits& limits, double heading_rad)
    : config_(config), limits_(limits), heading_rad_(heading_rad) {}

double LineTracking::wanted_heading_rad(double lateral_m, double to_release_s) const {
  const double fade_s = heading_first_constants / config_.heading_gain_per_s;
  const double weight = std::clamp((to_release_s - fade_s) / fade_s, 0.0, 1.0);
  const double towards_line = -std::atan(lateral_m / config_.lateral_length_m);
  return heading_rad_ +
         weight * std::clamp(towards_line, -config_.max_lateral_heading_rad, config_.max_lateral_heading_rad);
}

double LineTracking::step(double lateral_m, double heading_rad, double speed_mps, double to_release_s, Duration dt) {
  const double dt_s = seconds(dt);
  const double wanted = wanted_heading_rad(lateral_m, to_release_s);
  const double error_rad = std::remainder(wanted - heading_rad, 2.0 * std::numbers::pi);
  const double gain = config_.heading_gain_per_s;
  const double unbounded = gain * error_rad + curvature_per_m_ * speed_mps;
  const double bounded = std::clamp(unbounded, -limits_.max_yaw_rate_radps, limits_.max_yaw_rate_radps);
  if (speed_mps > learning_speed_mps && bounded == unbounded) {
    curvature_per_m_ += integral_part * gain * gain / speed_mps * error_rad * dt_s;
    curvature_per_m_ = std::clamp(curvature_per_m_, -max_curvature_per_m, max_curvature_per_m);
  }
  const double change = limits_.max_yaw_acceleration_radps2 * dt_s;
  ordered_radps_ = std::clamp(bounded, ordered_radps_ - change, ordered_radps_ + change);
  return ordered_radps_;
}

}  // namespace hogline::servo
