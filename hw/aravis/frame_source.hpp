// What the adapter needs of the camera library: buffers, one after the other. Aravis stands behind it, or a test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "hw/device_status.hpp"

namespace hogline::hw {

/// One buffer as it came off the wire.
struct CameraBuffer {
  bool complete = false;                ///< false: packets are missing; only frame_id means anything
  std::span<const std::uint8_t> bytes;  ///< valid until the next call of the source
  int width_px = 0;
  int height_px = 0;
  std::uint32_t pixel_format = 0;  ///< PFNC (EMVA), e.g. 0x01080001 Mono8
  std::uint64_t frame_id = 0;      ///< GigE Vision 1.x: 16 bits, 65535 is followed by 1. 0 is no number
  Duration wall{};                 ///< when its first packet came, since the Unix epoch; 0 if unknown
  std::optional<Duration> camera;  ///< the camera's own stamp, since an epoch of its own
};

struct CameraIdentity {
  std::string vendor;
  std::string model;
  std::string serial;
  std::string firmware;
  std::string address;  ///< IP address, or empty (USB)
  std::string describe() const;
};

struct SourceFault {
  DeviceErrorKind kind = DeviceErrorKind::disconnected;
  std::string what;
};

/// Used from one thread. start() and stop() may block for seconds.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Finds, opens and configures the camera, and starts the acquisition. On a fault everything is closed again.
  virtual std::optional<SourceFault> start() = 0;
  virtual void stop() = 0;
  /// The oldest buffer not yet given; waits for one as long as `patience`. Precondition: started.
  virtual std::optional<CameraBuffer> next(Duration patience) = 0;
  /// How many buffers next() would give without waiting.
  virtual std::size_t waiting() const = 0;
  /// The camera has been taken by another program, or does not answer any more.
  virtual bool control_lost() const = 0;
  /// Of the camera last opened.
  virtual const CameraIdentity& identity() const = 0;
};

}  // namespace hogline::hw
