// From frames to percepts: the cameras the controller asks for, and the time a look takes.
#pragma once

#include <optional>

#include "hw/camera.hpp"
#include "servo/command.hpp"
#include "src/throwing/look_times.hpp"
#include "src/throwing/sheet_seer.hpp"

namespace hogline {

class ThrowerEyes {
 public:
  /// The seer must outlive the eyes.
  ThrowerEyes(SheetSeer& seer, const LookTimes& times) : seer_(seer), times_(times) {}

  /// Publishes a look that is done by `now`; if none is under way, looks at the newest frame of the camera that is
  /// asked for, if there is a new one. `hint` confines the low view.
  void look(servo::CameraOrder order, hw::Camera& near_camera, hw::Camera& low_camera, Stamp now,
            const vision::LowViewPrediction& hint);

  const std::optional<SheetPosePercept>& near_view() const { return near_percept_; }
  const std::optional<SheetPosePercept>& low_view() const { return low_percept_; }
  int near_frames() const { return near_frames_; }
  int low_frames() const { return low_frames_; }

 private:
  void publish(Stamp now);

  SheetSeer& seer_;
  LookTimes times_;
  Stamp done_at_{};
  std::optional<SheetPosePercept> near_pending_;
  std::optional<SheetPosePercept> low_pending_;
  std::optional<SheetPosePercept> near_percept_;
  std::optional<SheetPosePercept> low_percept_;
  int near_frames_ = 0;
  int low_frames_ = 0;
};

}  // namespace hogline
