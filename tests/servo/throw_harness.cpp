#include "tests/servo/throw_harness.hpp"

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {

bool Outcome::reached(ThrowerState state) const {
  for (const StateEntry& entry : history) {
    if (entry.state == state) return true;
  }
  return false;
}

double Outcome::lasted_s(ThrowerState state) const {
  for (std::size_t i = 0; i + 1 < history.size(); ++i) {
    if (history[i].state == state) return seconds(history[i + 1].since - history[i].since);
  }
  return -1.0;
}

PlantSettings plain_settings(std::uint64_t seed) {
  PlantSettings settings;
  settings.seed = seed;
  settings.yaw_rad = (seed % 2 == 0 ? 5.0 : -5.0) * degree;
  settings.radius_error = seed % 3 == 0 ? -0.01 : 0.01;
  settings.radius_difference = seed % 4 < 2 ? 0.004 : -0.004;
  settings.gyro_bias_radps = seed % 5 < 2 ? 0.004 : -0.002;
  settings.breakaway_radps = 0.5 * degree * 0.25 / 0.1;
  settings.yaw_disturbance_radps = 0.003;
  return settings;
}

Outcome throw_stone(const ThrowerConfig& config, const ShotOrder& order, const PlantSettings& settings,
                    const Spoil& spoil, double longest_s) {
  Plant plant(config, settings);
  Thrower thrower(config, order, plant.now());
  Outcome outcome;
  const Stamp end = plant.now() + from_seconds(longest_s);
  while (plant.now() < end) {
    ThrowerObservation observation = plant.observe();
    if (spoil) spoil(observation, thrower);
    const ThrowerCommand command = thrower.step(observation, period);
    plant.apply(command);
    outcome.moments.push_back({observation.now, thrower.state(), command, plant.truth()});
  }
  outcome.finished = thrower.finished();
  outcome.released = thrower.released();
  outcome.jaws_opened = plant.jaws_opened();
  outcome.abort = thrower.abort_reason();
  outcome.history = thrower.history();
  outcome.yaw_after_alignment_rad = thrower.diagnosis().yaw_after_alignment_rad;
  outcome.at_release = plant.at_release();
  outcome.least_gap_m = plant.least_gap_m();
  return outcome;
}

}  // namespace hogline::servo::test
