// Port: one camera.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "hw/device_status.hpp"

namespace hogline::hw {

/// One picture. `bgr` is CV_8UC3 in the camera's response curve, or CV_8UC1.
struct Frame {
  cv::Mat bgr;
  Stamp stamp{};         ///< middle of the exposure, steady clock
  std::uint64_t id = 0;  ///< the camera's counter: a gap means lost frames
};

/// latest() never blocks and never gives the same frame twice.
class Camera {
 public:
  virtual ~Camera() = default;
  /// The newest frame that has arrived by `now` and was not given before; older ones are dropped. Nothing if none has.
  virtual std::optional<Frame> latest(Stamp now) = 0;
  /// Latched: frames that come again do not clear it.
  virtual std::optional<DeviceError> error() const = 0;
  /// Clears a latched error.
  virtual void rearm() = 0;
};

}  // namespace hogline::hw
