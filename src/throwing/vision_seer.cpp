#include "src/throwing/vision_seer.hpp"

#include <utility>

namespace hogline {

VisionSeer::VisionSeer(const vision::CameraSetup& near_setup, const vision::CameraSetup& low_setup)
    : near_(near_setup), low_(low_setup) {}

SheetPosePercept VisionSeer::near_view(const hw::Frame& frame) {
  vision::NearViewSketch sketch;
  SheetPosePercept percept = near_.step(frame.bgr, frame.stamp, std::nullopt, &sketch);
  if (percept.ok) near_sight_ = {.frame = frame, .sketch = std::move(sketch), .percept = percept};
  return percept;
}

SheetPosePercept VisionSeer::low_view(const hw::Frame& frame, const vision::LowViewPrediction&) {
  constexpr double not_measured_m = 10.0;
  vision::LowViewSketch sketch;
  SheetPosePercept percept = low_.step(frame.bgr, frame.stamp, &sketch);
  if (percept.ok && low_.diagnosis().blind) percept.sigma.y_m = percept.hog_distance_sigma_m = not_measured_m;
  if (percept.ok) low_sight_ = {.frame = frame, .sketch = std::move(sketch), .percept = percept};
  return percept;
}

}  // namespace hogline
