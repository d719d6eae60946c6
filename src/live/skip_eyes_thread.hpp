// Looks at the skip's pictures in a thread of its own, so that the head's control loop never waits for a look.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "hw/camera.hpp"
#include "hw/clock.hpp"
#include "hw/head.hpp"
#include "src/skip/skip_seer.hpp"

namespace hogline {

/// As VisionThread has it for the thrower: what its cameras give (a "frame" without a picture) stands for a look that
/// is done, and its seer hands out what was seen in it. Where the head pointed at a frame's exposure is remembered from
/// note(). Cameras and clock must outlive this, and be used by nobody else meanwhile.
class SkipEyesThread {
 public:
  /// Who looks at the pictures: made at once, and anew in the thread that looks after each forget().
  using MakeSeer = std::function<std::unique_ptr<SkipSeer>()>;

  SkipEyesThread(MakeSeer make_seer, hw::Camera& near, hw::Camera& far, const hw::Clock& clock);
  ~SkipEyesThread();
  SkipEyesThread(const SkipEyesThread&) = delete;
  SkipEyesThread& operator=(const SkipEyesThread&) = delete;

  /// Another throw begins: nothing of what was seen or known before counts, nor a look that still goes on.
  void forget();
  /// Every control period: how the head stands, and what the skip knows.
  void note(const hw::HeadState& head, const servo::SkipDiagnosis& known);
  hw::Camera& near_camera() { return near_; }
  hw::Camera& far_camera() { return far_; }
  SkipSeer& seer() { return seen_; }

 private:
  class Box final : public hw::Camera {
   public:
    Box(SkipEyesThread& eyes, hw::Camera& camera, std::function<void()> hand_out)
        : eyes_(eyes), camera_(camera), hand_out_(std::move(hand_out)) {}
    /// Also what was seen in it is handed out from now on.
    std::optional<hw::Frame> latest(Stamp now) override;
    std::optional<hw::DeviceError> error() const override;
    void rearm() override;

    /// In the thread that looks.
    std::optional<hw::Frame> take();
    /// Both under the mutex: what is handed out next.
    void deliver(const hw::Frame& frame);
    void forget() { done_.reset(); }

   private:
    SkipEyesThread& eyes_;
    hw::Camera& camera_;
    std::function<void()> hand_out_;
    Stamp asked_{};
    bool rearm_ = false;
    std::optional<hw::DeviceError> error_;
    std::optional<hw::Frame> done_;
  };

  struct Sights {
    servo::NearSight near;
    FarPercept far;
  };

  /// In the control loop's thread: a look that is done meanwhile does not change what was handed out.
  class Seen final : public SkipSeer {
   public:
    servo::NearSight near_view(const hw::Frame&, const servo::HeadAngles&, const servo::SkipDiagnosis&) override {
      return handed.near;
    }
    FarPercept far_view(const hw::Frame&, const servo::HeadAngles&, const servo::SkipDiagnosis&) override {
      return handed.far;
    }

    Sights handed;
  };

  /// What a look needs to know, and to which throw it belongs.
  struct Known {
    servo::SkipDiagnosis diagnosis;
    long throws = 0;
  };

  void run(const std::stop_token& stop);
  bool look_near();
  bool look_far();
  template <typename Sight>
  using View = Sight (SkipSeer::*)(const hw::Frame&, const servo::HeadAngles&, const servo::SkipDiagnosis&);
  template <typename Sight>
  bool look(Box& box, Sight& seen, View<Sight> view);
  Known known();
  std::optional<servo::HeadAngles> angles_at(Stamp stamp) const;

  MakeSeer make_seer_;
  std::unique_ptr<SkipSeer> seer_;  ///< of the thread that looks, as is what follows
  long seer_of_ = 1;
  const hw::Clock& clock_;
  mutable std::mutex mutex_;  ///< over all that follows, but for the cameras themselves
  std::deque<hw::HeadState> heads_;
  Known known_{.diagnosis = {}, .throws = 1};
  Box near_;
  Box far_;
  Sights sights_;
  Seen seen_;            ///< of the control loop
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace hogline
