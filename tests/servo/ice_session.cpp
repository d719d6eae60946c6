#include "tests/servo/ice_session.hpp"

#include <cmath>
#include <numbers>

namespace hogline::servo::test {

namespace {
constexpr double far_hog_m = 32.004;
constexpr int steps_per_look = 33;
}  // namespace

SheetOfIce unknown_sheet(std::mt19937_64& random) {
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  SheetOfIce sheet;
  sheet.ice.friction_scale = between(0.85, 1.2);
  sheet.ice.curl_gain = between(0.6, 1.1);
  sheet.ice.lateral_mps2 = between(-5e-4, 5e-4);
  return sheet;
}

ThrowerSkill robot() {
  return {.release = {0.0, 9.159},
          .max_speed_mps = 3.4,
          .spin_radps = 1.57,
          .speed_sigma_mps = 0.006,
          .heading_sigma_rad = 0.03 * std::numbers::pi / 180.0};
}

Delivery deliver(const ShotOrder& order, const SheetOfIce& sheet, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const ThrowerSkill skill = robot();
  const double speed = order.speed_mps + skill.speed_sigma_mps * normal(random);
  const double heading = order.heading_rad + skill.heading_sigma_rad * normal(random);
  const double spin = order.curl == Curl::counter_clockwise ? order.spin_radps : -order.spin_radps;

  Delivery delivery;
  delivery.ice = sheet.ice;
  delivery.ice.friction_scale *= 1.0 + sheet.throw_friction_sigma * normal(random);
  delivery.start = {skill.release.x_m, skill.release.y_m, -speed * std::sin(heading), speed * std::cos(heading), spin};
  delivery.track.spin_radps = spin;

  PlantStone stone;
  stone.motion = {delivery.start.x_m, delivery.start.y_m, delivery.start.vx_mps, delivery.start.vy_mps, spin, 0.0};
  ThrowPlant plant({stone}, delivery.ice);
  PlantView far = far_view(), near = near_view();
  far.camera_y_m = near.camera_y_m = skip_camera_y_m;
  const double far_tilt = far.tilt_sigma_rad * normal(random), near_tilt = near.tilt_sigma_rad * normal(random);
  int resting = 0;
  for (int i = 0; resting < 500; ++i) {
    plant.step();
    resting += plant.all_rest();
    if (i % steps_per_look != 0) continue;
    const hw::sim::StoneTruth& truth = plant.stones().front().motion;
    const bool is_far = truth.y_m < far_hog_m;
    delivery.track.looks.push_back(
        look_at(truth.x_m, truth.y_m, plant.now(), is_far ? far : near, is_far ? far_tilt : near_tilt, random));
  }
  delivery.rest = {plant.stones().front().motion.x_m, plant.stones().front().motion.y_m};
  return delivery;
}

}  // namespace hogline::servo::test
