#include "src/throwing/thrower_eyes.hpp"

#include <utility>

namespace hogline {

ThrowerEyes::ThrowerEyes(const vision::CameraSetup& near_setup, const vision::CameraSetup& low_setup,
                         const LookTimes& times)
    : times_(times), near_(near_setup), low_(low_setup) {}

void ThrowerEyes::look(servo::CameraOrder order, hw::Camera& near_camera, hw::Camera& low_camera, Stamp now,
                       const vision::LowViewPrediction& hint) {
  publish(now);
  if (near_pending_ || low_pending_) return;
  if (order == servo::CameraOrder::near) {
    if (const auto frame = near_camera.latest(now)) {
      look_near(*frame);
      done_at_ = now + times_.near;
    }
  } else if (order == servo::CameraOrder::low) {
    if (const auto frame = low_camera.latest(now)) {
      look_low(*frame, hint);
      done_at_ = now + times_.low;
    }
  }
  publish(now);
}

void ThrowerEyes::publish(Stamp now) {
  if (now < done_at_) return;
  if (near_pending_) near_percept_ = std::exchange(near_pending_, std::nullopt);
  if (low_pending_) low_percept_ = std::exchange(low_pending_, std::nullopt);
}

void ThrowerEyes::look_near(const hw::Frame& frame) {
  vision::NearViewSketch sketch;
  near_pending_ = near_.acquire(frame.bgr, frame.stamp, &sketch);
  ++near_frames_;
  if (near_pending_->ok) near_sight_ = {.frame = frame, .sketch = std::move(sketch), .percept = *near_pending_};
}

void ThrowerEyes::look_low(const hw::Frame& frame, const vision::LowViewPrediction& hint) {
  vision::LowViewSketch sketch;
  low_pending_ = low_.acquire(frame.bgr, frame.stamp, hint, &sketch);
  ++low_frames_;
  if (low_pending_->ok) low_sight_ = {.frame = frame, .sketch = std::move(sketch), .percept = *low_pending_};
}

}  // namespace hogline
