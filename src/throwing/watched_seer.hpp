// Tells of every look of another seer, beside the truth: how its errors are measured.
#pragma once

#include <functional>

#include "hw/sim/world_history.hpp"
#include "src/throwing/sheet_seer.hpp"

namespace hogline {

/// One look of one camera.
struct Look {
  bool low = false;  ///< the low camera's, else the near one's
  SheetPosePercept percept;
  PlanarPose truth;  ///< at the frame's exposure
};
using LookWatch = std::function<void(const Look&)>;

class WatchedSeer final : public SheetSeer {
 public:
  /// The seer and the history must outlive it. An empty watch is not called.
  WatchedSeer(SheetSeer& seer, const hw::sim::WorldHistory& history, LookWatch watch)
      : seer_(seer), history_(history), watch_(std::move(watch)) {}

  SheetPosePercept near_view(const hw::Frame& frame) override { return told(false, frame, seer_.near_view(frame)); }
  SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) override {
    return told(true, frame, seer_.low_view(frame, hint));
  }

 private:
  SheetPosePercept told(bool low, const hw::Frame& frame, SheetPosePercept percept) const {
    if (watch_) watch_({.low = low, .percept = percept, .truth = history_.at(frame.stamp).body});
    return percept;
  }

  SheetSeer& seer_;
  const hw::sim::WorldHistory& history_;
  LookWatch watch_;
};

}  // namespace hogline
