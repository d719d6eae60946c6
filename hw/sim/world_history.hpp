// The recent past of the simulated world, for cameras whose frames are exposed between two steps.
#pragma once

#include <mutex>

#include "hw/sim/moments.hpp"

namespace hogline::hw::sim {

/// Samples in the order of their stamps, kept for a while; between two of them all motion is taken to be even.
class WorldHistory {
 public:
  explicit WorldHistory(Duration kept) : samples_(kept) {}

  void add(const Truth& truth);
  void clear();

  struct Place {
    PlanarPose body;
    BodyTwist twist;
    double pitch_rad = 0.0;
    double pitch_rate_radps = 0.0;
    StoneTruth stone;
    int stone_team = 0;
    bool held = false;
    std::vector<StoneTruth> others;
    std::vector<int> other_teams;
    double arm_unfolded = 0.0;
  };
  /// Precondition: at least one sample. A stamp outside what is kept gives the nearest sample.
  Place at(Stamp stamp) const;

 private:
  mutable std::mutex mutex_;  ///< cameras may render in another thread than the one that steps the rink
  Moments<Truth> samples_;
};

}  // namespace hogline::hw::sim
