// When a frame was exposed, in the steady clock, from what the library and the camera say about it. Pure arithmetic.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "hw/aravis/aravis_config.hpp"
#include "hw/aravis/frame_source.hpp"

namespace hogline::hw {

/// The steady and the wall clock, read at the same moment.
struct TimePair {
  Stamp steady{};
  Duration wall{};  ///< since the Unix epoch
};

/// The difference between the camera's clock and ours, from frames that came later than they should by an unknown time
/// that is never negative: the smallest difference of the last ten seconds. So the quickest packet of ten seconds
/// counts, not the mean; 50 ppm of drift between the clocks make 0.5 ms in that time.
class ClockOffset {
 public:
  /// `difference` is ours less the camera's, for one frame that came at `now`.
  void add(Stamp now, Duration difference);
  std::optional<Duration> value() const;
  void forget() { bests_.clear(); }

 private:
  struct Best {
    Stamp second;
    Duration difference;
  };
  std::deque<Best> bests_;  ///< the smallest of each second
};

struct FrameStamp {
  Stamp middle{};              ///< of the exposure
  bool wall_replaced = false;  ///< the wall clock was stepped or gave nothing: the time of taking served instead
  bool camera_jumped = false;  ///< the camera's clock does not fit the frames before; the arrival served instead
};

/// Two ways, chosen by AravisConfig::stamp:
///  - by arrival: first packet's arrival - latency - half the exposure. The error is the network's and this machine's
///    delay of that packet: 0.1 ms on a quiet link, milliseconds on a loaded machine, never negative.
///  - by the camera's own stamp: middle of the exposure in the camera's clock + ClockOffset. The error is the least
///    delay of ten seconds plus the drift, below 1 ms, and the same for every frame.
class FrameStamps {
 public:
  explicit FrameStamps(const AravisConfig& config);

  /// Of a complete buffer taken from the library at `now`. Call in the order of arrival.
  FrameStamp stamp_of(const CameraBuffer& buffer, const TimePair& now);
  /// The camera was started anew.
  void restart();

 private:
  Stamp arrival_of(const CameraBuffer& buffer, const TimePair& now, FrameStamp& result);

  CameraStampMeaning meaning_;
  Duration half_exposure_;
  Duration latency_;
  std::optional<Duration> wall_less_steady_;  ///< at the last frame
  Duration transfer_{};                       ///< of the last frame: from its first packet to its taking
  ClockOffset offset_;
};

}  // namespace hogline::hw
