// Follows the truth through a throw, for what only the simulator can judge.
#pragma once

#include <optional>

#include "hw/sim/scenario.hpp"
#include "hw/sim/truth.hpp"
#include "servo/shot.hpp"
#include "servo/thrower.hpp"
#include "servo/thrower_config.hpp"
#include "src/throwing/throw_result.hpp"

namespace hogline {

class ThrowJudge {
 public:
  ThrowJudge(const servo::ThrowerConfig& config, const hw::sim::Scenario& scenario, const servo::ShotOrder& order,
             Stamp start);

  /// Once a control period.
  void watch(const hw::sim::Truth& truth, const servo::Thrower& thrower);
  ThrowResult verdict(const hw::sim::Truth& truth, const servo::Thrower& thrower, Stamp now) const;

 private:
  ReleaseOutcome judge_release(const hw::sim::ReleaseRecord& record) const;

  servo::ReleaseConfig release_;
  double stone_radius_m_;
  servo::ShotOrder order_;
  Stamp start_;
  std::optional<PlanarPose> line_start_;
  bool violation_ = false;
};

/// A released stone that has not come to rest.
bool stone_moves(const hw::sim::Truth& truth);

}  // namespace hogline
