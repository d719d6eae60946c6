#include "hw/sim/skip_history.hpp"

#include <algorithm>
#include <cassert>

namespace hogline::hw::sim {
namespace {

double mix(double a, double b, double share) { return a + share * (b - a); }

StoneTruth mix(const StoneTruth& a, const StoneTruth& b, double share) {
  return {mix(a.x_m, b.x_m, share),
          mix(a.y_m, b.y_m, share),
          mix(a.vx_mps, b.vx_mps, share),
          mix(a.vy_mps, b.vy_mps, share),
          mix(a.spin_radps, b.spin_radps, share),
          mix(a.handle_rad, b.handle_rad, share)};
}

}  // namespace

void SkipHistory::add(const SkipMoment& moment) {
  moments_.push_back(moment);
  while (moments_.size() > 2 && moments_.front().stamp < moment.stamp - kept_) moments_.pop_front();
}

SkipMoment SkipHistory::at(Stamp stamp) const {
  assert(!moments_.empty());
  auto later = std::ranges::lower_bound(moments_, stamp, {}, &SkipMoment::stamp);
  if (later == moments_.end()) --later;
  const SkipMoment& b = *later;
  const SkipMoment& a = later == moments_.begin() ? b : *std::prev(later);
  const double span_s = seconds(b.stamp - a.stamp);
  const double share = span_s > 0.0 ? std::clamp(seconds(stamp - a.stamp) / span_s, 0.0, 1.0) : 1.0;
  SkipMoment at = b;
  at.stamp = stamp;
  at.head = {mix(a.head.pan_rad, b.head.pan_rad, share), mix(a.head.tilt_rad, b.head.tilt_rad, share),
             mix(a.head.pan_radps, b.head.pan_radps, share), mix(a.head.tilt_radps, b.head.tilt_radps, share)};
  for (std::size_t i = 0; i < std::min(a.stones.size(), b.stones.size()); ++i) {
    at.stones[i].motion = mix(a.stones[i].motion, b.stones[i].motion, share);
  }
  return at;
}

}  // namespace hogline::hw::sim
