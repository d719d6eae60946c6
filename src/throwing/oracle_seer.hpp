// Sees what vision would see, from the simulator's truth: for campaigns of throws and for faults, where rendering and
// looking at full pictures would take minutes.
#pragma once

#include <cstdint>

#include "hw/sim/world_history.hpp"
#include "src/throwing/sheet_seer.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline {

/// How well one camera sees. Errors are independent from frame to frame, but for the bias, which is drawn once for a
/// throw (ice thicker than assumed, a mount that is slightly off).
struct SightQuality {
  PlanarSigma noise;
  PlanarSigma bias;
  PlanarSigma claimed;         ///< the standard deviations that the percept says it has
  double nearest_hog_m = 0.0;  ///< the sheet is seen while the hog distance is between these
  double farthest_hog_m = 0.0;
  double missing_share = 0.0;  ///< of the frames in between that show nothing
};

struct OracleQuality {
  SightQuality near;
  SightQuality low;
  double width_sigma_m = 0.0;
};

/// What vision reaches on the practice rink.
OracleQuality practice_quality();

struct OracleMounts {
  vision::Mount near;
  vision::Mount low;
};

/// Pictures are not looked at: where the body was when a frame was exposed is asked of the history, and an error is
/// added that depends on the seed and the frame's number alone. The head's camera sees only when the arm is unfolded.
class OracleSeer final : public SheetSeer {
 public:
  /// The history must outlive the seer and reach back to any frame's exposure.
  OracleSeer(const hw::sim::WorldHistory& history, double sheet_width_m, const OracleMounts& mounts,
             const OracleQuality& quality, std::uint64_t seed);

  SheetPosePercept near_view(const hw::Frame& frame) override;
  SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) override;

 private:
  SheetPosePercept see(const hw::Frame& frame, const SightQuality& quality, const vision::Mount& mount,
                       std::uint64_t seed) const;

  const hw::sim::WorldHistory& history_;
  double sheet_width_m_;
  OracleMounts mounts_;
  OracleQuality quality_;
  std::uint64_t seed_;
};

}  // namespace hogline
