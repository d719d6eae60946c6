#include "tests/servo/throw_plant.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::servo::test {

namespace {
constexpr double radius_m = 0.145;
}

hw::sim::StoneScenario scenario_of(const IceFactors& ice) {
  hw::sim::StoneScenario scenario;
  scenario.friction_scale = ice.friction_scale;
  scenario.curl_gain = ice.curl_gain;
  scenario.lateral_acceleration_mps2 = ice.lateral_mps2;
  scenario.spin_decay_scale = ice.spin_decay_scale;
  return scenario;
}

ThrowPlant::ThrowPlant(std::vector<PlantStone> stones, const IceFactors& ice, double restitution, double friction)
    : stones_(std::move(stones)), scenario_(scenario_of(ice)), restitution_(restitution), friction_(friction) {}

void ThrowPlant::step() {
  now_ += from_seconds(step_s);
  for (PlantStone& stone : stones_) {
    hw::sim::slide(stone.motion, scenario_, step_s);
    stone.motion.handle_rad += stone.motion.spin_radps * step_s;
  }
  for (std::size_t a = 0; a < stones_.size(); ++a) {
    for (std::size_t b = a + 1; b < stones_.size(); ++b) collide(a, b);
  }
}

// Equal discs: impulse along the line of centres, and a tangential one up to friction times it.
void ThrowPlant::collide(std::size_t a, std::size_t b) {
  hw::sim::StoneTruth &p = stones_[a].motion, &q = stones_[b].motion;
  const double dx = q.x_m - p.x_m, dy = q.y_m - p.y_m, gap = std::hypot(dx, dy);
  if (gap > 2.0 * radius_m) return;
  const double nx = dx / gap, ny = dy / gap;
  const double closing = (p.vx_mps - q.vx_mps) * nx + (p.vy_mps - q.vy_mps) * ny;
  if (closing <= 0.0) return;
  const bool p_faster = std::hypot(p.vx_mps, p.vy_mps) > std::hypot(q.vx_mps, q.vy_mps);
  const double j = 0.5 * (1.0 + restitution_) * closing;
  const double slip =
      -(p.vx_mps - q.vx_mps) * ny + (p.vy_mps - q.vy_mps) * nx + radius_m * (p.spin_radps + q.spin_radps);
  // Sticking takes a third of the slip from each (solid discs); sliding friction gives no more than its share.
  const double t = std::clamp(slip / 6.0, -friction_ * j, friction_ * j);
  p.vx_mps -= j * nx - t * ny;
  p.vy_mps -= j * ny + t * nx;
  q.vx_mps += j * nx - t * ny;
  q.vy_mps += j * ny + t * nx;
  const double inertia_share = 2.0 / radius_m;  // m r / I of a disc
  p.spin_radps -= t * inertia_share;
  q.spin_radps -= t * inertia_share;
  const hw::sim::StoneTruth& struck = p_faster ? q : p;
  contacts_.push_back({now_, static_cast<int>(p_faster ? a : b), static_cast<int>(p_faster ? b : a),
                       std::hypot(struck.vx_mps, struck.vy_mps)});
}

bool ThrowPlant::all_rest() const {
  return std::all_of(stones_.begin(), stones_.end(),
                     [](const PlantStone& stone) { return stone.motion.vx_mps == 0.0 && stone.motion.vy_mps == 0.0; });
}

PlantView far_view() { return {.view = View::far}; }

PlantView near_view() {
  return {.view = View::near,
          .across_rad = 1e-3,
          .across_least_m = 0.008,
          .along_m = 0.012,
          .tilt_noise_rad = 2.5e-4,
          .tilt_sigma_rad = 2.5e-4};
}

TrackLook look_at(double x_m, double y_m, Stamp stamp, const PlantView& view, double tilt_rad,
                  std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double dx = x_m - view.camera_x_m, dy = y_m - view.camera_y_m, range = std::hypot(dx, dy);
  const double ux = dx / range, uy = dy / range;
  const double by_tilt = range * range / view.camera_height_m;
  const double across = std::hypot(view.across_least_m, view.across_rad * range);
  const double along = std::hypot(view.along_m, view.tilt_noise_rad * by_tilt);
  const double a = along * normal(random) + by_tilt * tilt_rad, c = across * normal(random);
  TrackLook look;
  look.stamp = stamp;
  look.x_m = x_m + a * ux - c * uy;
  look.y_m = y_m + a * uy + c * ux;
  look.covariance = {along * along * ux * ux + across * across * uy * uy, (along * along - across * across) * ux * uy,
                     along * along * uy * uy + across * across * ux * ux};
  look.view = view.view;
  look.tilt = {view.camera_x_m, view.camera_y_m, view.tilt_sigma_rad / view.camera_height_m};
  return look;
}

}  // namespace hogline::servo::test
