// Adapter: a GigE Vision or USB3 Vision camera by Aravis, with a thread of its own. See doc/cameras.md.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "hw/aravis/camera_feed.hpp"
#include "hw/camera.hpp"
#include "hw/clock.hpp"

namespace hogline::hw {

/// latest() and error() never block for longer than it takes to copy a header. The frame's age is watched here as well
/// as in the thread: a call of the library that does not come back is silence too.
class AravisCamera final : public Camera {
 public:
  /// Opens in the background. The clock must outlive the camera and may be read from any thread.
  AravisCamera(const AravisConfig& config, const Clock& clock);
  /// The same over another source of buffers.
  AravisCamera(const AravisConfig& config, const Clock& clock, std::unique_ptr<FrameSource> source);
  /// Waits for the thread: up to seconds if the camera does not answer.
  ~AravisCamera() override;
  AravisCamera(const AravisCamera&) = delete;
  AravisCamera& operator=(const AravisCamera&) = delete;

  std::optional<Frame> latest(Stamp now) override;
  std::optional<DeviceError> error() const override;
  void rearm() override;
  FeedState state() const;

 private:
  void run();

  AravisConfig config_;
  const Clock& clock_;
  std::unique_ptr<FrameSource> source_;
  CameraFeed feed_;  // used by the thread only, as is the source

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Frame> newest_;  // under the mutex, as is what follows
  FeedState state_;
  mutable std::optional<DeviceError> stalled_;
  bool rearm_ = false;
  bool stopping_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace hogline::hw
