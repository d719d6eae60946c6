// Sees the near view as hogline does, and the low view by plain vpMeLine: to show what hogline's own is worth.
#pragma once

#include <optional>

#include "src/throwing/vision_seer.hpp"
#include "vision/plain/line_low_view.hpp"
#include "vision/plain/undistortion.hpp"

namespace hogline {

class LineSeer final : public SheetSeer {
 public:
  /// `near` must outlive the seer.
  LineSeer(SheetSeer& near, const vision::CameraSetup& low_setup) : near_(near), low_setup_(low_setup) {}

  SheetPosePercept near_view(const hw::Frame& frame) override { return near_.near_view(frame); }
  /// The lines are started where the hint has the body, and again after each loss.
  SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) override;

 private:
  SheetSeer& near_;
  vision::CameraSetup low_setup_;
  std::optional<vision::plain::Undistortion> undistortion_;
  std::optional<vision::plain::LineLowView> lines_;
  bool tracking_ = false;
};

}  // namespace hogline
