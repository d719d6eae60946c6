// A camera on the simulated rink: exposes at its frame rate in stepped time and delivers after a latency.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "hw/camera.hpp"
#include "hw/sim/sheet_renderer.hpp"

namespace hogline::hw::sim {

struct CameraTiming {
  Duration start{};  ///< middle of frame 0's exposure, after the epoch of the stepped clock
  double rate_hz = 60.0;
  double exposure_s = 0.003;
  double latency_s = 0.014;         ///< from the middle of the exposure to the frame's arrival
  double latency_jitter_s = 0.002;  ///< standard deviation
  double min_latency_s = 0.008;     ///< the jitter is cut off here
  double max_latency_s = 0.020;
};

/// Where the body is and how it moves, in the moment asked for.
struct BodyMotion {
  vision::Pose eMb;        ///< with the pitch and roll of a rocking body
  vision::Twist velocity;  ///< of b's origin in e, and the rate of turn about e's axes
};

/// What the camera needs of the world. Asked only for frames that are looked at, with the frame's stamp, which may lie
/// a few frames back; the answer must not depend on when it is asked.
struct CameraWorld {
  std::function<BodyMotion(Stamp)> body;
  std::function<void(Stamp, Exposure&)> things;  ///< adds stones and people; may be empty
  std::function<bool(Stamp)> uncovered;          ///< false: the camera is folded away and sees darkness; may be empty
};

/// Lazy: a frame is rendered when it is asked for, and nothing is spent on the others. Its bytes depend on its number
/// and on the world alone, not on which frames were looked at before. Every faulty camera keeps its frame clock.
class RenderedCamera final : public Camera {
 public:
  /// Precondition: rate and exposure positive, min_latency_s <= max_latency_s, `world.body` is set.
  RenderedCamera(SheetRenderer renderer, const vision::Pose& bMc, const CameraTiming& timing, CameraWorld world,
                 std::uint64_t seed);

  std::optional<Frame> latest(Stamp now) override;
  std::optional<DeviceError> error() const override { return std::nullopt; }
  void rearm() override {}

  /// Faults, from the next call of latest() on.
  enum class Fault {
    none,
    frozen,     ///< delivers the last picture again and again, with new numbers but its old stamp
    stopped,    ///< delivers nothing
    black,      ///< delivers on time, but the picture is dark
    saturated,  ///< ... every pixel is at the sensor's end
    repeated,   ///< ... the last picture again and again, with new numbers and stamps
    late,       ///< delivers 0.12 s later than it should
    time_back,  ///< its stamps go back by 0.1 s
    ahead,      ///< its stamps lie 0.2 s ahead: its clock is another one
  };
  void inject(Fault fault) { fault_ = fault; }

  Stamp stamp_of(std::uint64_t id) const;    ///< middle of a frame's exposure
  Stamp arrival_of(std::uint64_t id) const;  ///< not before any earlier frame's arrival

 private:
  Stamp own_arrival(std::uint64_t id) const;
  std::optional<std::uint64_t> newest(Stamp now) const;
  cv::Mat take(std::uint64_t id, Stamp stamp) const;

  SheetRenderer renderer_;
  vision::Pose bMc_;
  CameraTiming timing_;
  CameraWorld world_;
  std::uint64_t seed_;
  Fault fault_ = Fault::none;
  std::optional<std::uint64_t> given_;  ///< newest frame that was handed out or dropped
  std::optional<Frame> last_;           ///< newest good frame that was handed out
};

}  // namespace hogline::hw::sim
