// Sees the sheet in the pictures themselves.
#pragma once

#include <optional>

#include "src/throwing/sheet_seer.hpp"
#include "vision/low_sequence.hpp"
#include "vision/near_sequence.hpp"
#include "vision/near_view.hpp"

namespace hogline {

/// The newest frame in which the sheet was seen, with what was seen in it: for the pictures of the report.
template <typename Sketch>
struct Sight {
  hw::Frame frame;
  Sketch sketch;
  SheetPosePercept percept;
};

/// Whether each frame is looked at by itself, or followed from the frame before at a fraction of the cost.
enum class Looking { afresh, following };

class VisionSeer final : public SheetSeer {
 public:
  VisionSeer(const vision::CameraSetup& near_setup, const vision::CameraSetup& low_setup,
             Looking looking = Looking::afresh);

  SheetPosePercept near_view(const hw::Frame& frame) override;
  SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) override;

  const std::optional<Sight<vision::NearViewSketch>>& near_sight() const { return near_sight_; }
  const std::optional<Sight<vision::LowViewSketch>>& low_sight() const { return low_sight_; }

 private:
  Looking looking_;
  vision::NearView near_;
  vision::LowView low_;
  vision::NearSequence near_sequence_;
  vision::LowSequence low_sequence_;
  std::optional<Sight<vision::NearViewSketch>> near_sight_;
  std::optional<Sight<vision::LowViewSketch>> low_sight_;
};

}  // namespace hogline
