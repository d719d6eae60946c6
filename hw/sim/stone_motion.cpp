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

}  // namespace

void slide(StoneTruth& stone, const StoneScenario& scenario, double dt_s) {
  const double speed = std::hypot(stone.vx_mps, stone.vy_mps);
  const double slower = speed - scenario.friction_scale * deceleration_mps2(speed) * dt_s;
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

}  // namespace hogline::hw::sim
