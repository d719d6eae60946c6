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
  vision::LowViewSketch sketch;
  SheetPosePercept percept = looking_ == Looking::following ? low_sequence_.step(frame.bgr, frame.stamp, &sketch)
                                                            : low_.acquire(frame.bgr, frame.stamp, hint, &sketch);
  if (percept.ok) low_sight_ = {.frame = frame, .sketch = std::move(sketch), .percept = percept};
  return percept;
}

}  // namespace hogline
