#include "src/throwing/thrower_eyes.hpp"

namespace hogline {

ThrowerEyes::ThrowerEyes(const vision::CameraSetup& near_setup, const vision::CameraSetup& low_setup)
    : near_(near_setup), low_(low_setup) {}

void ThrowerEyes::look(servo::CameraOrder order, hw::Camera& near_camera, hw::Camera& low_camera, Stamp now,
                       const vision::LowViewPrediction& hint) {
  switch (order) {
    case servo::CameraOrder::near:
      if (const auto frame = near_camera.latest(now)) look_near(*frame);
      break;
    case servo::CameraOrder::low:
      if (const auto frame = low_camera.latest(now)) look_low(*frame, hint);
      break;
    case servo::CameraOrder::none:
      break;
  }
}

void ThrowerEyes::look_near(const hw::Frame& frame) {
  vision::NearViewSketch sketch;
  near_percept_ = near_.acquire(frame.bgr, frame.stamp, &sketch);
  ++near_frames_;
  if (near_percept_->ok) near_sight_ = {.frame = frame, .sketch = std::move(sketch), .percept = *near_percept_};
}

void ThrowerEyes::look_low(const hw::Frame& frame, const vision::LowViewPrediction& hint) {
  vision::LowViewSketch sketch;
  low_percept_ = low_.acquire(frame.bgr, frame.stamp, hint, &sketch);
  ++low_frames_;
  if (low_percept_->ok) low_sight_ = {.frame = frame, .sketch = std::move(sketch), .percept = *low_percept_};
}

}  // namespace hogline
