// Runs a whole throw on the plant and keeps what the tests ask about.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "servo/thrower.hpp"
#include "tests/servo/plant.hpp"

namespace hogline::servo::test {

/// One control period as it was.
struct Moment {
  Stamp now{};
  ThrowerState state = ThrowerState::unfold;  ///< after the step
  ThrowerCommand command;
  PlantTruth truth;
};

struct Outcome {
  bool finished = false;
  bool released = false;     ///< as the thrower says
  bool jaws_opened = false;  ///< as it was
  std::optional<std::string> abort;
  std::vector<StateEntry> history;
  std::vector<Moment> moments;
  std::optional<double> yaw_after_alignment_rad;
  std::optional<PlantTruth> at_release;
  double least_gap_m = 0.0;

  bool reached(ThrowerState state) const;
  double lasted_s(ThrowerState state) const;
};

/// A robot with the ordinary errors.
PlantSettings plain_settings(std::uint64_t seed = 1);

/// Changes what the thrower is told; called once a period with the state it is in.
using Spoil = std::function<void(ThrowerObservation&, const Thrower&)>;

/// Steps until `longest_s` is over, also past the end: what has finished must stay so.
Outcome throw_stone(const ThrowerConfig& config, const ShotOrder& order, const PlantSettings& settings,
                    const Spoil& spoil = {}, double longest_s = 30.0);

}  // namespace hogline::servo::test
