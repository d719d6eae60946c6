#include "hw/sim/robot_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::hw::sim {

namespace {

constexpr double gravity_mps2 = 9.80665;

}  // namespace

RobotDynamics::RobotDynamics(const RobotScenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      left_radius_m_(scenario.wheel_radius_m * (1.0 + scenario.left_radius_error)),
      right_radius_m_(scenario.wheel_radius_m * (1.0 + scenario.right_radius_error)),
      track_m_(scenario.track_m * (1.0 + scenario.track_error)),
      random_(seed),
      pose_{scenario.start_x_m, scenario.start_y_m, scenario.start_yaw_rad} {
  wander_ = unit_normal_(random_);
}

void RobotDynamics::put(const PlanarPose& pose) {
  pose_ = pose;
  forward_mps_ = wheel_yaw_radps_ = acceleration_mps2_ = 0.0;
  pitch_rad_ = pitch_rate_radps_ = left_radps_ = right_radps_ = 0.0;
  slipping_ = false;
}

BodyTwist RobotDynamics::twist() const {
  const double share = scenario_.yaw_disturbance_reference_mps > 0.0
                           ? std::abs(forward_mps_) / scenario_.yaw_disturbance_reference_mps
                           : 0.0;
  const double unmeasured =
      scenario_.steering_bias_rad_per_m * forward_mps_ + scenario_.yaw_disturbance_radps * share * wander_;
  return {.forward_mps = forward_mps_, .left_mps = 0.0, .yaw_radps = wheel_yaw_radps_ + unmeasured};
}

void RobotDynamics::step(const AxisSpeeds& axes, double load_kg, double load_x_m, double dt_s) {
  if (dt_s <= 0.0) return;
  const double mass = scenario_.mass_kg + load_kg;
  const double inertia = scenario_.yaw_inertia_kgm2 + load_kg * load_x_m * load_x_m;
  const double before = forward_mps_;
  const auto force = grip(axes, mass, inertia, dt_s);
  forward_mps_ += (force.left_n + force.right_n) / mass * dt_s;
  wheel_yaw_radps_ += 0.5 * track_m_ * (force.right_n - force.left_n) / inertia * dt_s;
  acceleration_mps2_ = (forward_mps_ - before) / dt_s;

  const double left_ground = forward_mps_ - 0.5 * track_m_ * wheel_yaw_radps_;
  const double right_ground = forward_mps_ + 0.5 * track_m_ * wheel_yaw_radps_;
  left_radps_ = axes.left_radps.value_or(left_ground / left_radius_m_);
  right_radps_ = axes.right_radps.value_or(right_ground / right_radius_m_);

  wander(dt_s);
  move(before, dt_s);
  rock(dt_s);
}

// Of one wheel. The runner takes what the centre of mass and the acceleration leave to it, and never pulls down.
double RobotDynamics::wheel_weight_n() const {
  const double whole = scenario_.mass_kg * gravity_mps2;
  if (scenario_.runner_x_m <= 0.0) return 0.5 * whole;
  const double ahead_m = scenario_.mass_x_m - scenario_.mass_z_m * acceleration_mps2_ / gravity_mps2;
  return 0.5 * whole * (1.0 - std::clamp(ahead_m / scenario_.runner_x_m, 0.0, 1.0));
}

// The impulse that ends each driven wheel's slip, but for its creep, within this step, as far as friction can give it.
// `stiffness` is the ground speed at a wheel per unit of its own impulse, `coupling` that per unit of the other's.
RobotDynamics::Forces RobotDynamics::grip(const AxisSpeeds& axes, double mass_kg, double inertia_kgm2, double dt_s) {
  const double half = 0.5 * track_m_;
  const double stiffness = 1.0 / mass_kg + half * half / inertia_kgm2;
  const double coupling = 1.0 / mass_kg - half * half / inertia_kgm2;
  const double weight_n = wheel_weight_n();
  const double limit = scenario_.friction_coefficient * weight_n * dt_s;
  const double left_ground = forward_mps_ - half * wheel_yaw_radps_;
  const double right_ground = forward_mps_ + half * wheel_yaw_radps_;
  const auto rolling = [&](double ground_mps) {
    const double most = scenario_.rolling_resistance * weight_n * dt_s;
    return -std::clamp(0.5 * mass_kg * ground_mps, -most, most);
  };
  const auto yielding = [&](double rim_mps) {
    return weight_n > 0.0 ? stiffness + scenario_.creep * std::abs(rim_mps) / (weight_n * dt_s) : stiffness;
  };

  double left = rolling(left_ground);
  double right = rolling(right_ground);
  const double left_rim = axes.left_radps.value_or(0.0) * left_radius_m_;
  const double right_rim = axes.right_radps.value_or(0.0) * right_radius_m_;
  const double left_gap = left_rim - left_ground;
  const double right_gap = right_rim - right_ground;
  const double left_own = yielding(left_rim);
  const double right_own = yielding(right_rim);
  const auto hold_left = [&] { left = std::clamp((left_gap - coupling * right) / left_own, -limit, limit); };
  const auto hold_right = [&] { right = std::clamp((right_gap - coupling * left) / right_own, -limit, limit); };

  if (axes.left_radps && axes.right_radps) {
    const double determinant = left_own * right_own - coupling * coupling;
    left = (right_own * left_gap - coupling * right_gap) / determinant;
    right = (left_own * right_gap - coupling * left_gap) / determinant;
    // The wheel that lacks more grip slips; the other one then holds what it can.
    if (std::abs(left) > limit && std::abs(left) >= std::abs(right)) {
      left = std::clamp(left, -limit, limit);
      hold_right();
    } else if (std::abs(right) > limit) {
      right = std::clamp(right, -limit, limit);
      hold_left();
    }
  } else if (axes.left_radps) {
    hold_left();
  } else if (axes.right_radps) {
    hold_right();
  }
  slipping_ = (axes.left_radps && std::abs(left) >= limit) || (axes.right_radps && std::abs(right) >= limit);
  return {left / dt_s, right / dt_s};
}

// Ornstein-Uhlenbeck, exact for any step.
void RobotDynamics::wander(double dt_s) {
  if (scenario_.yaw_disturbance_time_s <= 0.0) return;
  const double keep = std::exp(-dt_s / scenario_.yaw_disturbance_time_s);
  wander_ = keep * wander_ + std::sqrt(1.0 - keep * keep) * unit_normal_(random_);
}

void RobotDynamics::move(double forward_before_mps, double dt_s) {
  const double turn = twist().yaw_radps * dt_s;
  const double way = 0.5 * (forward_before_mps + forward_mps_) * dt_s;
  const double heading = pose_.yaw_rad + 0.5 * turn;
  pose_.x_m -= std::sin(heading) * way;
  pose_.y_m += std::cos(heading) * way;
  pose_.yaw_rad += turn;
}

void RobotDynamics::rock(double dt_s) {
  const double omega = 2.0 * std::numbers::pi * scenario_.pitch_natural_hz;
  const double rest = -scenario_.pitch_rad_per_mps2 * acceleration_mps2_;
  pitch_rate_radps_ +=
      (omega * omega * (rest - pitch_rad_) - 2.0 * scenario_.pitch_damping_ratio * omega * pitch_rate_radps_) * dt_s;
  pitch_rad_ += pitch_rate_radps_ * dt_s;
}

}  // namespace hogline::hw::sim
