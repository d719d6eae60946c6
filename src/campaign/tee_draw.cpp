#include "src/campaign/tee_draw.hpp"

#include <cmath>

#include "hw/sim/stone_motion.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::campaign {

hw::sim::StoneTruth resting_place(const hw::sim::Scenario& scenario, double hog_distance_m, double stone_x_m,
                                  const servo::ShotOrder& order) {
  constexpr double dt_s = 0.002;
  const double body_y_m = vision::rules::tee_to_hog_m - hog_distance_m;
  const double sense = order.curl == servo::Curl::counter_clockwise ? 1.0 : -1.0;
  hw::sim::StoneTruth stone;
  stone.x_m = scenario.robot.start_x_m - std::tan(order.heading_rad) * (body_y_m - scenario.robot.start_y_m) -
              std::sin(order.heading_rad) * stone_x_m;
  stone.y_m = body_y_m + std::cos(order.heading_rad) * stone_x_m;
  stone.vx_mps = -std::sin(order.heading_rad) * order.speed_mps;
  stone.vy_mps = std::cos(order.heading_rad) * order.speed_mps;
  stone.spin_radps = sense * order.spin_radps;
  while (moves(stone)) slide(stone, scenario.stone, dt_s);
  return stone;
}

// Newton's method: speed decides how far, heading how far to the side, each nearly alone.
servo::ShotOrder tee_draw(const hw::sim::Scenario& scenario, double hog_distance_m, double stone_x_m, servo::Curl curl,
                          double spin_radps) {
  constexpr int steps = 8;
  constexpr double small_mps = 0.005;
  constexpr double close_enough_m = 1e-4;
  servo::ShotOrder order{.speed_mps = 2.1, .heading_rad = 0.0, .curl = curl, .spin_radps = spin_radps};
  const auto rest = [&](const servo::ShotOrder& o) { return resting_place(scenario, hog_distance_m, stone_x_m, o); };
  for (int i = 0; i < steps; ++i) {
    const auto here = rest(order);
    const double short_m = vision::rules::tee_to_tee_m - here.y_m;
    if (std::hypot(short_m, here.x_m) < close_enough_m) break;
    servo::ShotOrder faster = order;
    faster.speed_mps += small_mps;
    const auto there = rest(faster);
    order.speed_mps += short_m * small_mps / (there.y_m - here.y_m);
    order.heading_rad += std::atan2(here.x_m, here.y_m - scenario.robot.start_y_m);
  }
  return order;
}

}  // namespace hogline::campaign
