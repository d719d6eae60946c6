#include "servo/stone_flow.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr double gravity_mps2 = 9.80665;
constexpr double friction_a = 0.00200985;
constexpr double friction_b_mps = 0.06385782;
constexpr double friction_c = 0.00626286;
constexpr double curl_radps = 0.00820;
constexpr double curl_exponent = -0.8;
constexpr double spin_loss_mps3 = 0.025;
constexpr double spin_loss_least_mps = 0.001;
constexpr double dead_spin_radps = 1e-3;

double fcv1_deceleration(double speed) { return gravity_mps2 * (friction_a / (speed + friction_b_mps) + friction_c); }

double fcv1_deceleration_slope(double speed) {
  const double u = speed + friction_b_mps;
  return -gravity_mps2 * friction_a / (u * u);
}

double sense_of(double spin) { return spin > 0.0 ? 1.0 : spin < 0.0 ? -1.0 : 0.0; }

double fcv1_turn(double speed, double spin) { return sense_of(spin) * curl_radps * std::pow(speed, curl_exponent); }

double spin_loss(double speed, const IceFactors& ice) {
  return ice.spin_decay_scale * spin_loss_mps3 / std::max(speed, spin_loss_least_mps);
}

Eigen::Vector2d left_of(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

StoneFlow moved(const StoneFlow& flow, const StoneFlow& rates, double dt_s) {
  StoneFlow to;
  to.state = flow.state + dt_s * rates.state;
  to.spin_radps = flow.spin_radps + dt_s * rates.spin_radps;
  to.by_start = flow.by_start + dt_s * rates.by_start;
  return to;
}

}  // namespace

StoneFlow flow_from(const SlidingStone& stone) {
  StoneFlow flow;
  flow.state << stone.x_m, stone.y_m, stone.vx_mps, stone.vy_mps;
  flow.spin_radps = stone.spin_radps;
  flow.by_start.leftCols<4>().setIdentity();
  return flow;
}

double speed_mps(const StoneFlow& flow) { return std::hypot(flow.state[2], flow.state[3]); }

StoneFlow rates_of(const StoneFlow& flow, const IceFactors& ice) {
  const Eigen::Vector2d velocity = flow.state.tail<2>();
  const double speed = velocity.norm();
  const Eigen::Vector2d along = velocity / speed;
  const Eigen::Vector2d left = left_of(along);
  const double slower = fcv1_deceleration(speed);
  const double turn = fcv1_turn(speed, flow.spin_radps);

  StoneFlow rates;
  rates.state.head<2>() = velocity;
  rates.state.tail<2>() = -ice.friction_scale * slower * along + ice.curl_gain * turn * speed * left;
  rates.state[2] += ice.lateral_mps2;
  rates.spin_radps = -sense_of(flow.spin_radps) * spin_loss(speed, ice);

  // By the velocity: along it, the deceleration and v^0.2 change; across it, both turn with it.
  const double slower_slope = fcv1_deceleration_slope(speed);
  Eigen::Matrix2d by_velocity =
      (-ice.friction_scale * slower_slope * along + (1.0 + curl_exponent) * ice.curl_gain * turn * left) *
      along.transpose();
  by_velocity += (-ice.friction_scale * slower / speed * left - ice.curl_gain * turn * along) * left.transpose();
  rates.by_start.topRows<2>() = flow.by_start.bottomRows<2>();
  rates.by_start.bottomRows<2>() = by_velocity * flow.by_start.bottomRows<2>();
  rates.by_start.col(4).tail<2>() -= slower * along;
  rates.by_start.col(5).tail<2>() += turn * speed * left;
  rates.by_start(2, 6) += 1.0;
  return rates;
}

double step_s(const StoneFlow& flow, const IceFactors& ice, double longest_s) {
  const double speed = speed_mps(flow);
  double step = std::min(longest_s, 0.25 * speed / (ice.friction_scale * fcv1_deceleration(speed)));
  const double loss = spin_loss(speed, ice);
  if (flow.spin_radps != 0.0 && loss > 0.0) step = std::min(step, std::abs(flow.spin_radps) / loss);
  return std::max(step, 1e-4);
}

StoneFlow stepped(const StoneFlow& flow, const IceFactors& ice, double dt_s) {
  const StoneFlow first = rates_of(flow, ice);
  const StoneFlow second = rates_of(moved(flow, first, 0.5 * dt_s), ice);
  const StoneFlow third = rates_of(moved(flow, second, 0.5 * dt_s), ice);
  const StoneFlow fourth = rates_of(moved(flow, third, dt_s), ice);
  StoneFlow mean;
  mean.state = (first.state + 2.0 * second.state + 2.0 * third.state + fourth.state) / 6.0;
  mean.spin_radps = (first.spin_radps + 2.0 * second.spin_radps + 2.0 * third.spin_radps + fourth.spin_radps) / 6.0;
  mean.by_start = (first.by_start + 2.0 * second.by_start + 2.0 * third.by_start + fourth.by_start) / 6.0;
  StoneFlow to = moved(flow, mean, dt_s);
  const bool died = to.spin_radps * flow.spin_radps <= 0.0 || (dt_s > 0.0 && std::abs(to.spin_radps) < dead_spin_radps);
  if (died) to.spin_radps = 0.0;
  return to;
}

double last_phase_s(const StoneFlow& flow, const IceFactors& ice) {
  const double speed = speed_mps(flow);
  return speed / (ice.friction_scale * fcv1_deceleration(0.5 * speed));
}

StoneFlow in_last_phase_after(const StoneFlow& flow, const IceFactors& ice, double dt_s) {
  const double speed = speed_mps(flow);
  if (speed <= 0.0) return flow;
  const double whole_s = last_phase_s(flow, ice);
  const bool rests = dt_s >= whole_s;
  const double t = std::min(dt_s, whole_s);
  const double fcv1 = fcv1_deceleration(0.5 * speed);
  const double slower = ice.friction_scale * fcv1;
  const double slower_slope = 0.5 * ice.friction_scale * fcv1_deceleration_slope(0.5 * speed);
  const Eigen::Vector2d along = flow.state.tail<2>() / speed;
  const Eigen::Matrix2d lengthwise = along * along.transpose();
  const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - lengthwise;

  StoneFlow to = flow;
  to.state.head<2>() += along * (speed * t - 0.5 * slower * t * t);
  to.state.tail<2>() = rests ? Eigen::Vector2d::Zero() : Eigen::Vector2d(along * (speed - slower * t));

  const auto velocities = flow.by_start.bottomRows<2>();
  const Eigen::Matrix2d place_by_velocity =
      t * Eigen::Matrix2d::Identity() - 0.5 * t * t * (slower / speed * across + slower_slope * lengthwise);
  to.by_start.topRows<2>() += place_by_velocity * velocities;
  to.by_start.col(4).head<2>() -= 0.5 * fcv1 * t * t * along;
  if (rests) {
    to.by_start.bottomRows<2>().setZero();
    to.spin_radps = 0.0;
    return to;
  }
  to.by_start.bottomRows<2>() =
      (Eigen::Matrix2d::Identity() - t * (slower / speed * across + slower_slope * lengthwise)) * velocities;
  to.by_start.col(4).tail<2>() -= fcv1 * t * along;
  return to;
}

double speed_mps(const SlidingStone& stone) { return std::hypot(stone.vx_mps, stone.vy_mps); }

double deceleration_mps2(double speed_mps, const IceFactors& ice) {
  return ice.friction_scale * fcv1_deceleration(speed_mps);
}

double turn_radps(double speed_mps, double spin_radps, const IceFactors& ice) {
  return ice.curl_gain * fcv1_turn(speed_mps, spin_radps);
}

}  // namespace hogline::servo
