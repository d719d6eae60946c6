// Sets an open camera as the rig file says, and checks that it took it. Inside hw/aravis only: knows libaravis.
#pragma once

#include <arv.h>

#include <optional>
#include <string>

#include "hw/aravis/aravis_config.hpp"
#include "hw/aravis/frame_source.hpp"

namespace hogline::hw::aravis {

/// Takes a GError from a call and frees it.
class Failure {
 public:
  Failure() = default;
  Failure(const Failure&) = delete;
  Failure& operator=(const Failure&) = delete;
  ~Failure() { g_clear_error(&error_); }

  GError** place() {
    g_clear_error(&error_);
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }
  /// "opening: Device not found".
  std::string text(const char* doing) const {
    return std::string(doing) + ": " + (error_ != nullptr ? error_->message : "no reason given");
  }

 private:
  GError* error_ = nullptr;
};

CameraIdentity read_identity(ArvCamera* camera);

/// Region, pixel format, exposure, gain, rate; free running, no automatics. A value that does not stick is a fault.
std::optional<SourceFault> apply_settings(ArvCamera* camera, const AravisConfig& config);

}  // namespace hogline::hw::aravis
