// Looks at pictures in a thread of its own, so that the control loop never waits for a look.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "hw/camera.hpp"
#include "hw/clock.hpp"
#include "src/throwing/sheet_seer.hpp"

namespace hogline {

/// Between two cameras with their seer on one side and the control loop on the other. The loop gets cameras and a seer
/// as ever: a "frame" that its camera gives (without a picture) stands for a look that is done, and its seer hands the
/// percept out. Only the newest look is kept, and only the newest frame is looked at: what comes while a look goes on
/// is passed over by the camera. The cameras, the seer behind and the clock must outlive this, and be used by nobody
/// else meanwhile.
class VisionThread {
 public:
  /// `at_begin` is called in the thread before anything else, e.g. to set its priority.
  VisionThread(SheetSeer& seer, hw::Camera& near_camera, hw::Camera& low_camera, const hw::Clock& clock,
               std::function<void()> at_begin = {});
  ~VisionThread();
  VisionThread(const VisionThread&) = delete;
  VisionThread& operator=(const VisionThread&) = delete;

  hw::Camera& near_camera() { return near_; }
  hw::Camera& low_camera() { return low_; }
  SheetSeer& seer() { return mailbox_seer_; }
  int looks() const { return looks_; }

 private:
  /// One camera as the control loop sees it.
  class Mailbox final : public hw::Camera {
   public:
    Mailbox(hw::Camera& camera, const hw::Clock& clock) : camera_(camera), clock_(clock) {}
    std::optional<hw::Frame> latest(Stamp now) override;
    std::optional<hw::DeviceError> error() const override;
    void rearm() override;

    SheetPosePercept percept(const vision::LowViewPrediction& hint);
    bool wanted() const;  ///< somebody asked a moment ago
    /// In the vision thread: a frame to look at, if there is one.
    std::optional<hw::Frame> take();
    vision::LowViewPrediction hint() const;
    void deliver(const hw::Frame& frame, SheetPosePercept percept);

   private:
    hw::Camera& camera_;
    const hw::Clock& clock_;
    mutable std::mutex mutex_;
    Stamp asked_{};
    bool rearm_ = false;
    vision::LowViewPrediction hint_;
    std::optional<hw::DeviceError> error_;
    std::optional<hw::Frame> done_;  ///< without its picture; not yet handed out
    SheetPosePercept percept_;       ///< in that frame
    SheetPosePercept handed_;        ///< in the frame that was handed out last, whatever has been seen since
  };

  class MailboxSeer final : public SheetSeer {
   public:
    MailboxSeer(Mailbox& near, Mailbox& low) : near_(near), low_(low) {}
    SheetPosePercept near_view(const hw::Frame&) override { return near_.percept({}); }
    SheetPosePercept low_view(const hw::Frame&, const vision::LowViewPrediction& hint) override {
      return low_.percept(hint);
    }

   private:
    Mailbox& near_;
    Mailbox& low_;
  };

  void run(const std::stop_token& stop);

  SheetSeer& seer_;
  const hw::Clock& clock_;
  Mailbox near_;
  Mailbox low_;
  MailboxSeer mailbox_seer_;
  std::atomic<int> looks_ = 0;
  std::jthread thread_;
};

}  // namespace hogline
