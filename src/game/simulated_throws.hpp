// Throws without robots: FCV1 with a session's factors and collisions, a thrower that is not quite true, and a skip
// whose looks teach the ice model. Each throw ends within its own step.
#pragma once

#include <cstdint>
#include <random>

#include "hw/sim/board_run.hpp"
#include "src/game/stone_thrower.hpp"

namespace hogline::game {

struct SimulatedSheet {
  servo::IceFactors ice;  ///< the truth, which nobody is told
  double restitution = 0.88;
  double stone_friction = 0.1;
  double throw_friction_sigma = 0.005;  ///< share, from throw to throw
  std::optional<double> width_m = 4.75;
};

/// Friction 0.85-1.2 and curl 0.6-1.1 of FCV1's, lateral +-0.3 mm/s2, spin decay 0.7-1.4, restitution 0.80-0.95.
SimulatedSheet any_sheet(std::uint64_t seed);

/// How well the skip sees a running stone: independent looks, ten a second.
struct SkipEyes {
  double sigma_m = 0.02;
  double from_y_m = 14.0;  ///< s: where its far view begins
};

class SimulatedThrows final : public StoneThrower {
 public:
  SimulatedThrows(const SimulatedSheet& sheet, const servo::ThrowerSkill& skill, const servo::IceModel& ice,
                  std::uint64_t seed, const SkipEyes& eyes = {});

  void start(const Turn& turn, Stamp now) override;
  std::optional<ThrowReport> step(Stamp now) override;
  const servo::IceModel& ice() const { return ice_; }
  const SimulatedSheet& sheet() const { return sheet_; }

 private:
  ThrowReport thrown(const Turn& turn);
  hw::sim::StoneTruth released(const servo::ShotOrder& order);
  void learn(const hw::sim::BoardRun& run, const hw::sim::BoardStones& before, std::size_t stone, double spin_radps);

  SimulatedSheet sheet_;
  servo::ThrowerSkill skill_;
  servo::IceModel ice_;
  SkipEyes eyes_;
  std::mt19937_64 random_;
  std::optional<ThrowReport> report_;
};

}  // namespace hogline::game
