// What a history of the simulated world is made of: samples in the order of their stamps, kept for a while, and what
// lies between two of them, where all motion is taken to be even.
#pragma once

#include <algorithm>
#include <cassert>
#include <deque>
#include <iterator>

#include "hw/sim/truth.hpp"

namespace hogline::hw::sim {

inline double mix(double a, double b, double share) { return a + share * (b - a); }

inline StoneTruth mix(const StoneTruth& a, const StoneTruth& b, double share) {
  return {mix(a.x_m, b.x_m, share),
          mix(a.y_m, b.y_m, share),
          mix(a.vx_mps, b.vx_mps, share),
          mix(a.vy_mps, b.vy_mps, share),
          mix(a.spin_radps, b.spin_radps, share),
          mix(a.handle_rad, b.handle_rad, share)};
}

/// `Sample` has a `stamp`.
template <typename Sample>
class Moments {
 public:
  explicit Moments(Duration kept) : kept_(kept) {}

  void add(const Sample& sample) {
    samples_.push_back(sample);
    while (samples_.size() > 2 && samples_.front().stamp < sample.stamp - kept_) samples_.pop_front();
  }

  void clear() { samples_.clear(); }

  /// `share`: 0 at `before`, 1 at `after`; `span_s`: between the two, 0 where they are one and the same.
  struct Between {
    const Sample& before;
    const Sample& after;
    double share;
    double span_s;
  };
  /// Precondition: at least one sample. A stamp outside what is kept gives the nearest sample.
  Between at(Stamp stamp) const {
    assert(!samples_.empty());
    auto later = std::ranges::lower_bound(samples_, stamp, {}, &Sample::stamp);
    if (later == samples_.end()) --later;
    const Sample& after = *later;
    const Sample& before = later == samples_.begin() ? after : *std::prev(later);
    const double span_s = seconds(after.stamp - before.stamp);
    const double share = span_s > 0.0 ? std::clamp(seconds(stamp - before.stamp) / span_s, 0.0, 1.0) : 1.0;
    return {before, after, share, span_s};
  }

 private:
  Duration kept_;
  std::deque<Sample> samples_;
};

}  // namespace hogline::hw::sim
