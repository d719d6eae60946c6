// From frames to percepts: the cameras the controller asks for, through vision.
#pragma once

#include <optional>

#include "hw/camera.hpp"
#include "servo/command.hpp"
#include "src/throwing/look_times.hpp"
#include "vision/low_view.hpp"
#include "vision/near_view.hpp"

namespace hogline {

/// The newest frame that was looked at, with what was seen in it: for the pictures of the report.
template <typename Sketch>
struct Sight {
  hw::Frame frame;
  Sketch sketch;
  SheetPosePercept percept;
};

class ThrowerEyes {
 public:
  ThrowerEyes(const vision::CameraSetup& near_setup, const vision::CameraSetup& low_setup, const LookTimes& times);

  /// Publishes a look that is done by `now`; if none is under way, looks at the newest frame of the camera that is
  /// asked for, if there is a new one. `hint` confines the low view.
  void look(servo::CameraOrder order, hw::Camera& near_camera, hw::Camera& low_camera, Stamp now,
            const vision::LowViewPrediction& hint);

  const std::optional<SheetPosePercept>& near_view() const { return near_percept_; }
  const std::optional<SheetPosePercept>& low_view() const { return low_percept_; }
  /// The last frame in which the sheet was seen.
  const std::optional<Sight<vision::NearViewSketch>>& near_sight() const { return near_sight_; }
  const std::optional<Sight<vision::LowViewSketch>>& low_sight() const { return low_sight_; }
  int near_frames() const { return near_frames_; }
  int low_frames() const { return low_frames_; }

 private:
  void look_near(const hw::Frame& frame);
  void look_low(const hw::Frame& frame, const vision::LowViewPrediction& hint);

  void publish(Stamp now);

  LookTimes times_;
  Stamp done_at_{};
  std::optional<SheetPosePercept> near_pending_;
  std::optional<SheetPosePercept> low_pending_;
  vision::NearView near_;
  vision::LowView low_;
  std::optional<SheetPosePercept> near_percept_;
  std::optional<SheetPosePercept> low_percept_;
  std::optional<Sight<vision::NearViewSketch>> near_sight_;
  std::optional<Sight<vision::LowViewSketch>> low_sight_;
  int near_frames_ = 0;
  int low_frames_ = 0;
};

}  // namespace hogline
