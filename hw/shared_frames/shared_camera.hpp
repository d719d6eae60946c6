// Adapter: a camera whose pictures another program writes into shared memory.
#pragma once

#include <string>

#include "hw/camera.hpp"
#include "hw/shared_frames/frame_ring.hpp"

namespace hogline::hw {

struct SharedCameraConfig {
  std::string name;     ///< "near camera": stands in errors
  std::string segment;  ///< of the shared memory, without a slash
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  Duration silence_limit{};                         ///< a writer whose beat is older is gone
  Duration first_limit = std::chrono::seconds(10);  ///< the same before the first writer was found
};

/// Looks for the segment anew by itself. A writer that is gone, or another one in its place, is a latched error:
/// pictures come again only after rearm(). After a pause in the asking (longer than silence_limit) it looks for the
/// segment anew, and that is no error. A picture that is overwritten while it is copied is not given. Used by one
/// thread.
class SharedCamera final : public Camera {
 public:
  explicit SharedCamera(SharedCameraConfig config) : config_(std::move(config)) {}

  std::optional<Frame> latest(Stamp now) override;
  std::optional<DeviceError> error() const override { return error_; }
  void rearm() override;

 private:
  void note_asking(Stamp now);
  bool connect(Stamp now);
  bool alive(Stamp now);
  std::optional<Frame> copy(std::uint64_t number) const;
  void fail(DeviceErrorKind kind, std::string what, Stamp now);

  SharedCameraConfig config_;
  std::optional<FrameRingMapping> ring_;
  std::uint32_t channels_ = 0;   ///< as it was when the ring was found
  std::uint64_t given_ = 0;      ///< pictures of this ring given or passed over
  std::uint64_t last_id_ = 0;    ///< given to anybody
  std::uint64_t id_offset_ = 0;  ///< of this ring: numbers that are given grow from ring to ring
  std::optional<Stamp> asked_since_;
  std::optional<Stamp> last_asked_;
  Stamp next_look_{};
  std::optional<DeviceError> error_;
};

}  // namespace hogline::hw
