// Whole throws in closed loop: the plant knows the truth, the thrower does not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>

#include "servo/thrower.hpp"
#include "tests/servo/plant.hpp"
#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

struct Outcome {
  bool released = false;
  std::optional<std::string> abort;
  double place_error_m = 0.0;
  double speed_error_mps = 0.0;
  double heading_error_rad = 0.0;
  double yaw_after_alignment_rad = 0.0;
  double align_s = 0.0;
  double duration_s = 0.0;
  double least_gap_m = 0.0;
  double lateral_m = 0.0;
  std::vector<double> trace;
};

Outcome throw_stone(const ThrowerConfig& config, const ShotOrder& order, const PlantSettings& settings) {
  Plant plant(config, settings);
  Thrower thrower(config, order, plant.now());
  const Stamp start = plant.now();
  Outcome outcome;
  for (int i = 0; i < 12000 && !thrower.finished(); ++i) {
    plant.apply(thrower.step(plant.observe(), period));
    outcome.trace.push_back(plant.truth().yaw_rad);
    outcome.trace.push_back(plant.truth().speed_mps);
  }
  outcome.released = thrower.released();
  outcome.abort = thrower.abort_reason();
  outcome.duration_s = seconds(plant.now() - start);
  outcome.least_gap_m = plant.least_gap_m();
  for (std::size_t i = 0; i + 1 < thrower.history().size(); ++i) {
    if (thrower.history()[i].state == ThrowerState::align) {
      outcome.align_s = seconds(thrower.history()[i + 1].since - thrower.history()[i].since);
    }
  }
  outcome.yaw_after_alignment_rad = thrower.diagnosis().yaw_after_alignment_rad.value_or(NAN) - order.heading_rad;
  if (plant.at_release()) {
    const PlantTruth& truth = *plant.at_release();
    outcome.place_error_m = truth.hog_distance_m - config.release.hog_distance_m;
    outcome.speed_error_mps = truth.speed_mps - order.speed_mps;
    outcome.heading_error_rad = truth.yaw_rad - order.heading_rad;
    const double along = truth.y_m - (6.401 - settings.hog_distance_m);
    outcome.lateral_m = -(truth.x_m - settings.x_m) * std::cos(order.heading_rad) - along * std::sin(order.heading_rad);
  }
  return outcome;
}

TEST(Probe, Throws) {
  for (double speed : {1.91, 2.09, 2.54, 2.76, 3.30}) {
    for (std::uint64_t seed : {1u, 2u}) {
      PlantSettings s;
      s.seed = seed;
      s.yaw_rad = (seed % 2 ? 8 : -8) * degree;
      s.gyro_bias_radps = 0.002;
      s.radius_difference = 0.004;
      s.breakaway_radps = 0.6 * degree * 0.9 * 0.25 / 0.1;
      ShotOrder o = draw();
      o.speed_mps = speed;
      const Outcome r = throw_stone(thrower_config(), o, s);
      std::cout << speed << " " << seed << " rel " << r.released << " abort " << r.abort.value_or("-") << " place "
                << r.place_error_m * 1e3 << " mm speed " << r.speed_error_mps * 1e3 << " mm/s head "
                << r.heading_error_rad / degree << " deg lat " << r.lateral_m * 1e3 << " mm yawal "
                << r.yaw_after_alignment_rad / degree << " align " << r.align_s << " dur " << r.duration_s << " gap "
                << r.least_gap_m * 1e3 << "\n";
    }
  }
}

}  // namespace
}  // namespace hogline::servo::test
