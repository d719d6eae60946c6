#include "hw/sim/world_history.hpp"

namespace hogline::hw::sim {
namespace {

PlanarPose mix(const PlanarPose& a, const PlanarPose& b, double share) {
  return {sim::mix(a.x_m, b.x_m, share), sim::mix(a.y_m, b.y_m, share), sim::mix(a.yaw_rad, b.yaw_rad, share)};
}

BodyTwist mix(const BodyTwist& a, const BodyTwist& b, double share) {
  return {sim::mix(a.forward_mps, b.forward_mps, share), sim::mix(a.left_mps, b.left_mps, share),
          sim::mix(a.yaw_radps, b.yaw_radps, share)};
}

}  // namespace

void WorldHistory::add(const Truth& truth) {
  const std::lock_guard lock(mutex_);
  samples_.add(truth);
}

void WorldHistory::clear() {
  const std::lock_guard lock(mutex_);
  samples_.clear();
}

WorldHistory::Place WorldHistory::at(Stamp stamp) const {
  const std::lock_guard lock(mutex_);
  const auto [a, b, share, span_s] = samples_.at(stamp);
  return {.body = mix(a.body, b.body, share),
          .twist = mix(a.twist, b.twist, share),
          .pitch_rad = sim::mix(a.pitch_rad, b.pitch_rad, share),
          .pitch_rate_radps = span_s > 0.0 ? (b.pitch_rad - a.pitch_rad) / span_s : 0.0,
          .stone = sim::mix(a.stone, b.stone, share),
          .stone_team = b.stone_team,
          .held = b.held,
          .others = b.others,
          .other_teams = b.other_teams,
          .arm_unfolded = sim::mix(a.arm_unfolded, b.arm_unfolded, share)};
}

}  // namespace hogline::hw::sim
