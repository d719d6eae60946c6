#include "hw/sim/world_history.hpp"

#include <algorithm>
#include <cassert>

namespace hogline::hw::sim {

namespace {

double mix(double a, double b, double share) { return a + share * (b - a); }

PlanarPose mix(const PlanarPose& a, const PlanarPose& b, double share) {
  return {mix(a.x_m, b.x_m, share), mix(a.y_m, b.y_m, share), mix(a.yaw_rad, b.yaw_rad, share)};
}

BodyTwist mix(const BodyTwist& a, const BodyTwist& b, double share) {
  return {mix(a.forward_mps, b.forward_mps, share), mix(a.left_mps, b.left_mps, share),
          mix(a.yaw_radps, b.yaw_radps, share)};
}

StoneTruth mix(const StoneTruth& a, const StoneTruth& b, double share) {
  return {mix(a.x_m, b.x_m, share),
          mix(a.y_m, b.y_m, share),
          mix(a.vx_mps, b.vx_mps, share),
          mix(a.vy_mps, b.vy_mps, share),
          mix(a.spin_radps, b.spin_radps, share),
          mix(a.handle_rad, b.handle_rad, share)};
}

}  // namespace

void WorldHistory::add(const Truth& truth) {
  const std::lock_guard lock(mutex_);
  samples_.push_back(truth);
  while (samples_.size() > 2 && samples_.front().stamp < truth.stamp - kept_) samples_.pop_front();
}

WorldHistory::Place WorldHistory::at(Stamp stamp) const {
  const std::lock_guard lock(mutex_);
  assert(!samples_.empty());
  auto later = std::ranges::lower_bound(samples_, stamp, {}, &Truth::stamp);
  if (later == samples_.end()) --later;
  const auto& b = *later;
  const auto& a = later == samples_.begin() ? b : *std::prev(later);
  const double span_s = seconds(b.stamp - a.stamp);
  const double share = span_s > 0.0 ? std::clamp(seconds(stamp - a.stamp) / span_s, 0.0, 1.0) : 1.0;
  return {.body = mix(a.body, b.body, share),
          .twist = mix(a.twist, b.twist, share),
          .pitch_rad = mix(a.pitch_rad, b.pitch_rad, share),
          .pitch_rate_radps = span_s > 0.0 ? (b.pitch_rad - a.pitch_rad) / span_s : 0.0,
          .stone = mix(a.stone, b.stone, share),
          .held = b.held,
          .others = b.others,
          .arm_unfolded = mix(a.arm_unfolded, b.arm_unfolded, share)};
}

}  // namespace hogline::hw::sim
