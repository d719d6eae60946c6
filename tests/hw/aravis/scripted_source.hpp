// A camera library whose buffers a test writes down beforehand, and the two clocks they arrive in.
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "hw/aravis/camera_feed.hpp"

namespace hogline::hw {

inline constexpr int test_width_px = 64;
inline constexpr int test_height_px = 48;
inline constexpr std::uint32_t test_mono8 = 0x01080001;

/// Both clocks stand still until they are stepped.
struct TestClocks {
  Stamp steady{std::chrono::seconds(100)};
  Duration wall{std::chrono::hours(24 * 365 * 50)};
  void advance(Duration step) {
    steady += step;
    wall += step;
  }
  TimePair now() const { return {steady, wall}; }
};

/// A buffer that comes off the wire at `at`: its first packet came `transfer` before.
struct Arrival {
  Stamp at{};
  std::uint64_t id = 0;
  Stamp camera{};  ///< start of the exposure, in the steady clock; the camera's own clock differs
  Duration transfer = std::chrono::milliseconds(3);
  bool complete = true;
  int width_px = test_width_px;
  int height_px = test_height_px;
  std::uint32_t format = test_mono8;
};

class ScriptedSource final : public FrameSource {
 public:
  explicit ScriptedSource(TestClocks& clocks) : clocks_(clocks) {}

  std::optional<SourceFault> start() override {
    ++starts;
    if (!start_faults.empty()) {
      auto fault = std::exchange(start_faults.front(), std::nullopt);
      start_faults.pop_front();
      if (fault) return fault;
    }
    open = true;
    started_at = clocks_.steady;
    return std::nullopt;
  }
  void stop() override {
    open = false;
    lost = false;
  }
  std::optional<CameraBuffer> next(Duration patience) override {
    const Stamp until = clocks_.steady + patience;
    while (!arrivals.empty()) {
      const Arrival arrival = arrivals.front();
      if (arrival.at > until) break;
      arrivals.pop_front();
      if (arrival.at < started_at || static_cast<int>(mute_starts) >= starts) continue;
      if (arrival.at > clocks_.steady) clocks_.advance(arrival.at - clocks_.steady);
      return buffer_of(arrival);
    }
    clocks_.advance(until - clocks_.steady);
    return std::nullopt;
  }
  std::size_t waiting() const override {
    return static_cast<std::size_t>(std::count_if(arrivals.begin(), arrivals.end(), [this](const Arrival& a) {
      return a.at <= clocks_.steady && a.at >= started_at && static_cast<int>(mute_starts) < starts;
    }));
  }
  bool control_lost() const override { return lost; }
  const CameraIdentity& identity() const override { return identity_; }

  std::deque<Arrival> arrivals;
  std::deque<std::optional<SourceFault>> start_faults;
  int mute_starts = 0;  ///< so many first starts deliver nothing
  int starts = 0;
  bool open = false;
  bool lost = false;
  Duration camera_offset = std::chrono::hours(-3);  ///< the camera's clock less the steady one
  double camera_drift = 0.0;                        ///< how much faster it runs, 1 = twice as fast
  bool has_wall = true;

 private:
  CameraBuffer buffer_of(const Arrival& a) {
    bytes_.assign(static_cast<std::size_t>(a.width_px) * static_cast<std::size_t>(a.height_px), 0);
    for (std::size_t i = 0; i < bytes_.size(); ++i) bytes_[i] = static_cast<std::uint8_t>(i * 7 + a.id * 13);
    CameraBuffer b;
    b.complete = a.complete;
    b.bytes = bytes_;
    b.width_px = a.width_px;
    b.height_px = a.height_px;
    b.pixel_format = a.format;
    b.frame_id = a.id;
    b.wall = has_wall ? clocks_.wall - (clocks_.steady - (a.at - a.transfer)) : Duration{};
    const double drifted_s = seconds(a.camera.time_since_epoch()) * (1.0 + camera_drift);
    b.camera = from_seconds(drifted_s) + camera_offset;
    return b;
  }

  TestClocks& clocks_;
  CameraIdentity identity_{"Maker", "Model", "S1", "1.0", "10.0.0.2"};
  Stamp started_at{};
  std::vector<std::uint8_t> bytes_;
};

inline AravisConfig test_config() {
  using namespace std::chrono_literals;
  AravisConfig c;
  c.name = "low camera";
  c.serial = "S1";
  c.width_px = test_width_px;
  c.height_px = test_height_px;
  c.pixel_format = "Mono8";
  c.exposure_s = 0.004;
  c.frame_rate_hz = 60.0;
  c.latency = 2ms;
  c.first_frame_limit = 500ms;
  c.silence_limit = 60ms;
  c.retry_delay = 200ms;
  return c;
}

/// Frame k of a 62.5 Hz stream: exposed from 16 k ms on for 4 ms, 2 ms of read-out, 3 ms of transfer.
inline Arrival arrival_of(int k, Stamp begin) {
  using namespace std::chrono_literals;
  Arrival a;
  a.camera = begin + k * Duration(16ms);
  a.at = a.camera + 4ms + 2ms + 3ms;
  a.id = static_cast<std::uint64_t>(1 + k);
  return a;
}

inline Stamp middle_of(int k, Stamp begin) {
  using namespace std::chrono_literals;
  return begin + k * Duration(16ms) + 2ms;
}

}  // namespace hogline::hw
