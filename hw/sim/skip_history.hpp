// The recent past of the skip's rink, for cameras whose frames are exposed between two steps.
#pragma once

#include <optional>
#include <vector>

#include "hw/sim/moments.hpp"
#include "hw/sim/stone_field.hpp"

namespace hogline::hw::sim {

/// The head's true angles: pan about b's z axis, counter-clockwise positive; tilt positive looks down.
struct HeadTruth {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
  double pan_radps = 0.0;
  double tilt_radps = 0.0;
};

struct SkipMoment {
  Stamp stamp{};
  HeadTruth head;
  std::vector<FieldStone> stones;
  std::optional<std::size_t> thrown;  ///< number of the thrown stone, once it is on the ice
  std::optional<Stamp> released;      ///< when it was let go
};

/// Moments in the order of their stamps, kept for a while; between two of them all motion is taken to be even.
class SkipHistory {
 public:
  explicit SkipHistory(Duration kept) : moments_(kept) {}
  void add(const SkipMoment& moment) { moments_.add(moment); }
  /// Precondition: at least one moment. A stamp outside what is kept gives the nearest moment.
  SkipMoment at(Stamp stamp) const;

 private:
  Moments<SkipMoment> moments_;
};

}  // namespace hogline::hw::sim
