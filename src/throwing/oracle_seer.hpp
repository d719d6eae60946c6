// Sees what vision would see, from the simulator's truth: for campaigns of throws and for faults, where rendering and
// looking at full pictures would take minutes.
#pragma once

#include <cstdint>
#include <optional>

#include "hw/sim/world_history.hpp"
#include "src/throwing/oracle_quality.hpp"
#include "src/throwing/sheet_seer.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline {

struct OracleMounts {
  vision::Mount near;
  vision::Mount low;
};

/// Pictures are not looked at: where the body was when a frame was exposed is asked of the history, and an error is
/// added that was measured on vision (OracleQuality). It depends on the seed, the frames' numbers and which frames were
/// looked at. The head's camera sees only when the arm is unfolded.
class OracleSeer final : public SheetSeer {
 public:
  /// The history must outlive the seer and reach back to any frame's exposure.
  OracleSeer(const hw::sim::WorldHistory& history, double sheet_width_m, const OracleMounts& mounts,
             OracleQuality quality, std::uint64_t seed);

  SheetPosePercept near_view(const hw::Frame& frame) override;
  SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) override;

 private:
  /// One camera's errors as they go on from frame to frame; each of unit variance.
  struct Eye {
    std::uint64_t seed = 0;
    PlanarPose bias;
    PlanarPose drift;
    std::optional<Stamp> last;
  };
  SheetPosePercept see(const hw::Frame& frame, const SightQuality& quality, const vision::Mount& mount, Eye& eye) const;

  const hw::sim::WorldHistory& history_;
  double sheet_width_m_;
  OracleMounts mounts_;
  OracleQuality quality_;
  Eye near_;
  Eye low_;
};

}  // namespace hogline
