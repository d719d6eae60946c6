// Who sees the sheet in a frame: vision, or on the simulated rink an oracle that costs next to nothing.
#pragma once

#include "hw/camera.hpp"
#include "vision/low_view.hpp"
#include "vision/percepts/sheet_pose.hpp"

namespace hogline {

/// One frame in, one percept out. The frame's stamp becomes the percept's.
class SheetSeer {
 public:
  virtual ~SheetSeer() = default;
  virtual SheetPosePercept near_view(const hw::Frame& frame) = 0;
  /// `hint` confines the search.
  virtual SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) = 0;
};

}  // namespace hogline
