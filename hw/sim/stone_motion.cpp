#include "hw/sim/stone_motion.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::hw::sim {

namespace {

constexpr double gravity_mps2 = 9.80665;

double deceleration_mps2(double speed_mps) {
  return gravity_mps2 * (0.00200985 / (speed_mps + 0.06385782) + 0.00626286);
}

double curl_radps(double speed_mps, double spin_radps) {
  if (spin_radps == 0.0) return 0.0;
  return std::copysign(0.00820 * std::pow(speed_mps, -0.8), spin_radps);
}

// 0.19 to 0.21 kg m2 are usual for 18 to 20 kg: a disc of the same radius is within a per cent of that.
double inertia_kgm2(const StoneScenario& stone) { return 0.5 * stone.mass_kg * stone.radius_m * stone.radius_m; }

}  // namespace

void slide(StoneTruth& stone, const StoneScenario& scenario, double dt_s) {
  const double speed = std::hypot(stone.vx_mps, stone.vy_mps);
  const double lane = 1.0 + scenario.lane_friction * std::abs(stone.x_m);
  const double slower = speed - scenario.friction_scale * lane * deceleration_mps2(speed) * dt_s;
  if (speed == 0.0 || slower <= 0.0) {
    stone.vx_mps = stone.vy_mps = stone.spin_radps = 0.0;
    return;
  }
  const double turn = scenario.curl_gain * curl_radps(speed, stone.spin_radps) * dt_s;
  const double c = std::cos(turn) * slower / speed;
  const double s = std::sin(turn) * slower / speed;
  const double vx = c * stone.vx_mps - s * stone.vy_mps + scenario.lateral_acceleration_mps2 * dt_s;
  const double vy = s * stone.vx_mps + c * stone.vy_mps;
  stone.x_m += 0.5 * (stone.vx_mps + vx) * dt_s;
  stone.y_m += 0.5 * (stone.vy_mps + vy) * dt_s;
  stone.vx_mps = vx;
  stone.vy_mps = vy;

  const double spin_loss = scenario.spin_decay_scale * 0.025 / std::max(speed, 0.001) * dt_s;
  stone.spin_radps = std::copysign(std::max(std::abs(stone.spin_radps) - spin_loss, 0.0), stone.spin_radps);
}

bool moves(const StoneTruth& stone) { return stone.vx_mps != 0.0 || stone.vy_mps != 0.0 || stone.spin_radps != 0.0; }

// Both have the same mass m and inertia I. With n from a to b and t to its left, a's rim runs along t with
// v_t + w R at the point of touch, b's with v_t - w R.
bool collide(StoneTruth& a, StoneTruth& b, const StoneScenario& scenario) {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  const double apart = std::hypot(dx, dy);
  if (apart > 2.0 * scenario.radius_m || apart == 0.0) return false;
  const double nx = dx / apart;
  const double ny = dy / apart;
  const double approach = (a.vx_mps - b.vx_mps) * nx + (a.vy_mps - b.vy_mps) * ny;
  if (approach <= 0.0) return false;

  const double arm = 0.5 * apart;
  const double along = -(a.vx_mps - b.vx_mps) * ny + (a.vy_mps - b.vy_mps) * nx;
  const double sliding = along + arm * (a.spin_radps + b.spin_radps);
  const double turn = scenario.mass_kg * arm / inertia_kgm2(scenario);    // per impulse / m across
  const double per_mass = 0.5 * (1.0 + scenario.restitution) * approach;  // impulse / m, on b along n
  const double to_stop = std::abs(sliding) / (2.0 * (1.0 + arm * turn));  // ends the sliding
  const double across = std::copysign(std::min(scenario.stone_friction * per_mass, to_stop), sliding);  // on b along t

  const double jx = per_mass * nx - across * ny;
  const double jy = per_mass * ny + across * nx;
  a.vx_mps -= jx;
  a.vy_mps -= jy;
  b.vx_mps += jx;
  b.vy_mps += jy;
  a.spin_radps -= turn * across;
  b.spin_radps -= turn * across;
  return true;
}

}  // namespace hogline::hw::sim
