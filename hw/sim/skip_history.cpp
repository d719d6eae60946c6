#include "hw/sim/skip_history.hpp"

namespace hogline::hw::sim {
namespace {

HeadTruth mix(const HeadTruth& a, const HeadTruth& b, double share) {
  return {sim::mix(a.pan_rad, b.pan_rad, share), sim::mix(a.tilt_rad, b.tilt_rad, share),
          sim::mix(a.pan_radps, b.pan_radps, share), sim::mix(a.tilt_radps, b.tilt_radps, share)};
}

}  // namespace

SkipMoment SkipHistory::at(Stamp stamp) const {
  const auto [before, after, share, span_s] = moments_.at(stamp);
  SkipMoment at = after;
  at.stamp = stamp;
  at.head = mix(before.head, after.head, share);
  for (std::size_t i = 0; i < std::min(before.stones.size(), after.stones.size()); ++i) {
    at.stones[i].motion = sim::mix(before.stones[i].motion, after.stones[i].motion, share);
  }
  return at;
}

}  // namespace hogline::hw::sim
