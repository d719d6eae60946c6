#include "src/throwing/vision_seer.hpp"

#include <utility>

namespace hogline {

VisionSeer::VisionSeer(const vision::CameraSetup& near_setup, const vision::CameraSetup& low_setup, Looking looking)
    : looking_(looking), near_(near_setup), low_(low_setup), near_sequence_(near_setup), low_sequence_(low_setup) {}

SheetPosePercept VisionSeer::near_view(const hw::Frame& frame) {
  vision::NearViewSketch sketch;
  SheetPosePercept percept = looking_ == Looking::following
                                 ? near_sequence_.step(frame.bgr, frame.stamp, std::nullopt, &sketch)
                                 : near_.acquire(frame.bgr, frame.stamp, &sketch);
  if (percept.ok) near_sight_ = {.frame = frame, .sketch = std::move(sketch), .percept = percept};
  return percept;
}

SheetPosePercept VisionSeer::low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) {
  constexpr double not_measured_m = 10.0;
  const bool follows = looking_ == Looking::following;
  vision::LowViewSketch sketch;
  SheetPosePercept percept = follows ? low_sequence_.step(frame.bgr, frame.stamp, &sketch)
                                     : low_.acquire(frame.bgr, frame.stamp, hint, &sketch);
  const bool blind = follows && percept.ok && low_sequence_.diagnosis().blind;
  if (blind) percept.sigma.y_m = percept.hog_distance_sigma_m = not_measured_m;
  if (percept.ok) low_sight_ = {.frame = frame, .sketch = std::move(sketch), .percept = percept};
  return percept;
}

}  // namespace hogline
