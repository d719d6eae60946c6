// One control period of the skip: head and cameras to observation, controller, commands to the head. It knows only the
// ports, and is the same on the simulated rink and on steel.
#pragma once

#include <deque>
#include <optional>

#include "hw/camera.hpp"
#include "hw/head.hpp"
#include "servo/skip.hpp"
#include "src/skip/skip_seer.hpp"

namespace hogline {

struct SkipDevices {
  hw::Head& head;
  hw::Camera& near;
  hw::Camera& far;
};

class SkipLoop {
 public:
  /// Devices and seer must outlive it.
  SkipLoop(const SkipDevices& devices, SkipSeer& seer, servo::Skip skip);

  /// What the thrower tells when it lets go; taken in with the next step.
  void hear(const servo::ReleaseSignal& signal) { heard_ = signal; }
  /// The spin that was ordered; before the stone is let go.
  void expect(double spin_radps) { skip_.expect(spin_radps); }
  /// `now` is the present time, `dt` the time since the last call.
  void step(Stamp now, Duration dt);

  const servo::Skip& skip() const { return skip_; }
  const servo::SkipCommand& command() const { return command_; }
  int near_frames() const { return near_frames_; }
  int far_frames() const { return far_frames_; }

 private:
  servo::SkipObservation observe(Stamp now);
  void see(servo::SkipObservation& observation, Stamp now);
  std::optional<servo::HeadAngles> angles_at(Stamp stamp) const;
  void apply(Stamp now);

  SkipDevices devices_;
  SkipSeer& seer_;
  servo::Skip skip_;
  servo::SkipCommand command_;
  std::optional<servo::ReleaseSignal> heard_;
  std::deque<servo::HeadJoints> joints_;
  int near_frames_ = 0;
  int far_frames_ = 0;
};

}  // namespace hogline
