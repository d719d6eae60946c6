// Looks at the skip's pictures in a thread of its own, so that the head's control loop never waits for a look.
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <thread>

#include "hw/camera.hpp"
#include "hw/clock.hpp"
#include "hw/head.hpp"
#include "src/skip/skip_seer.hpp"

namespace hogline {

/// As VisionThread has it for the thrower: what its cameras give (a "frame" without a picture) stands for a look that
/// is done, and its seer hands out what was seen. Where the head pointed at a frame's exposure is remembered from
/// note(). Cameras, seer and clock must outlive this, and be used by nobody else meanwhile.
class SkipEyesThread {
 public:
  SkipEyesThread(SkipSeer& seer, hw::Camera& near, hw::Camera& far, const hw::Clock& clock);
  ~SkipEyesThread();
  SkipEyesThread(const SkipEyesThread&) = delete;
  SkipEyesThread& operator=(const SkipEyesThread&) = delete;

  /// Every control period: how the head stands, and what the skip knows.
  void note(const hw::HeadState& head, const servo::SkipDiagnosis& known);
  hw::Camera& near_camera() { return near_; }
  hw::Camera& far_camera() { return far_; }
  SkipSeer& seer() { return seen_; }

 private:
  class Box final : public hw::Camera {
   public:
    Box(SkipEyesThread& eyes, hw::Camera& camera) : eyes_(eyes), camera_(camera) {}
    std::optional<hw::Frame> latest(Stamp now) override;
    std::optional<hw::DeviceError> error() const override;
    void rearm() override;

    /// In the thread that looks.
    std::optional<hw::Frame> take();
    void deliver(const hw::Frame& frame);

   private:
    SkipEyesThread& eyes_;
    hw::Camera& camera_;
    Stamp asked_{};
    bool rearm_ = false;
    std::optional<hw::DeviceError> error_;
    std::optional<hw::Frame> done_;
  };

  class Seen final : public SkipSeer {
   public:
    explicit Seen(std::mutex& mutex) : mutex_(mutex) {}
    servo::NearSight near_view(const hw::Frame&, const servo::HeadAngles&, const servo::SkipDiagnosis&) override {
      const std::lock_guard lock(mutex_);
      return near;
    }
    FarPercept far_view(const hw::Frame&, const servo::HeadAngles&, const servo::SkipDiagnosis&) override {
      const std::lock_guard lock(mutex_);
      return far;
    }

    servo::NearSight near;  ///< under the mutex, as is what follows
    FarPercept far;

   private:
    std::mutex& mutex_;
  };

  void run(const std::stop_token& stop);
  bool look_near();
  bool look_far();
  std::optional<servo::HeadAngles> angles_at(Stamp stamp) const;

  SkipSeer& seer_;
  const hw::Clock& clock_;
  mutable std::mutex mutex_;  ///< over all that follows, but for the cameras themselves
  std::deque<hw::HeadState> heads_;
  servo::SkipDiagnosis known_;
  Box near_;
  Box far_;
  Seen seen_{mutex_};
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace hogline
