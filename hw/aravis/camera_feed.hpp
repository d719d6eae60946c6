// Keeps one camera delivering: opens, watches, starts anew, and turns buffers into frames. A state machine without a
// thread; AravisCamera gives it one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "hw/aravis/aravis_config.hpp"
#include "hw/aravis/frame_numbers.hpp"
#include "hw/aravis/frame_source.hpp"
#include "hw/aravis/frame_stamps.hpp"
#include "hw/camera.hpp"

namespace hogline::hw {

enum class FeedPhase {
  closed,     ///< not found or given up: tried again every retry_delay
  starting,   ///< acquisition started, no complete frame yet
  streaming,  ///< frames come
};

const char* to_string(FeedPhase phase);

/// Since construction.
struct FeedCounters {
  std::uint64_t starts = 0;         ///< of the acquisition
  std::uint64_t mute_starts = 0;    ///< of these, without a frame within the limit
  std::uint64_t frames = 0;         ///< complete ones
  std::uint64_t overtaken = 0;      ///< of these, dropped for a newer one
  std::uint64_t incomplete = 0;     ///< dropped: packets missing
  std::uint64_t lost = 0;           ///< gaps in the camera's numbers
  std::uint64_t refused = 0;        ///< dropped: wrong size or format, number or time going back
  std::uint64_t wall_replaced = 0;  ///< stamped without the library's wall clock
  std::uint64_t outages = 0;        ///< times that `streaming` was left
};

struct FeedState {
  FeedPhase phase = FeedPhase::closed;
  CameraIdentity identity;
  FeedCounters counters;
  Stamp last_frame{};                ///< when the newest complete frame was taken from the library
  std::optional<DeviceError> error;  ///< latched
};

class CameraFeed {
 public:
  using Clocks = std::function<TimePair()>;
  /// The source must outlive the feed.
  CameraFeed(FrameSource& source, AravisConfig config, Clocks clocks);
  ~CameraFeed();
  CameraFeed(const CameraFeed&) = delete;
  CameraFeed& operator=(const CameraFeed&) = delete;

  /// One turn: opens if it is time to, or takes what has arrived and waits up to `patience` for the first of it. The
  /// newest good frame, if there is one; older ones are dropped.
  std::optional<Frame> step(Duration patience);
  const FeedState& state() const { return state_; }
  /// Clears a latched error. Connecting goes on in any case.
  void rearm();

 private:
  void open();
  void close();
  std::optional<Frame> take(const CameraBuffer& buffer, bool last);
  bool usable(const CameraBuffer& buffer, bool backward, Stamp now);
  void watch(Stamp now);
  void fail(DeviceErrorKind kind, std::string what, Stamp now);

  FrameSource& source_;
  AravisConfig config_;
  Clocks clocks_;
  FrameNumbers numbers_;
  FrameStamps stamps_;
  FeedState state_;
  std::uint64_t mute_in_a_row_ = 0;
  Stamp started_{};
  Stamp retry_at_{};
  std::optional<Stamp> last_stamp_;
};

}  // namespace hogline::hw
