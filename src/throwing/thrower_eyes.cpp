#include "src/throwing/thrower_eyes.hpp"

#include <utility>

namespace hogline {
namespace {

Duration time_of(const SheetPosePercept& percept, Duration acquired, Duration tracked) {
  if (!percept.ok || percept.features.empty()) return acquired;
  const std::string& how = percept.features.front();
  return how == "tracked" || how == "dead_reckoning" ? tracked : acquired;
}

}  // namespace

void ThrowerEyes::look(servo::CameraOrder order, hw::Camera& near_camera, hw::Camera& low_camera, Stamp now,
                       const vision::LowViewPrediction& hint) {
  publish(now);
  if (near_pending_ || low_pending_) return;
  if (order == servo::CameraOrder::near) {
    if (const auto frame = near_camera.latest(now)) {
      near_pending_ = seer_.near_view(*frame);
      ++near_frames_;
      done_at_ = now + time_of(*near_pending_, times_.near, times_.tracked);
    }
  } else if (order == servo::CameraOrder::low) {
    if (const auto frame = low_camera.latest(now)) {
      low_pending_ = seer_.low_view(*frame, hint);
      ++low_frames_;
      done_at_ = now + time_of(*low_pending_, times_.low, times_.tracked);
    }
  }
  publish(now);
}

void ThrowerEyes::publish(Stamp now) {
  if (now < done_at_) return;
  for (auto* pending : {&near_pending_, &low_pending_}) {
    if (*pending && !times_.compensated) (*pending)->stamp = now;
  }
  if (near_pending_) near_percept_ = std::exchange(near_pending_, std::nullopt);
  if (low_pending_) low_percept_ = std::exchange(low_pending_, std::nullopt);
}

}  // namespace hogline
