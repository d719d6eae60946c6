// Cameras that play a recording on any clock, the stepped one too: the same calls give the same frames.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hw/camera.hpp"
#include "hw/files/recording.hpp"

namespace cv {
class VideoCapture;
}

namespace hogline::hw::files {

/// A frame arrives at its stamp, which is the recording's time after `start`. After the last one there are no more.
class RecordedCamera : public Camera {
 public:
  /// The stamp of the next frame; nothing at the recording's end. latest(*next_stamp()) gives just that frame.
  virtual std::optional<Stamp> next_stamp() const = 0;
  /// How many frames the recording says it has; nothing where it does not say.
  virtual std::optional<std::uint64_t> promised_frames() const { return std::nullopt; }
};

/// A picture that can not be used (missing, damaged, another size than the rig's) is a latched error and is passed
/// over.
class FolderCamera final : public RecordedCamera {
 public:
  /// Precondition: the recording has no problem.
  FolderCamera(std::string name, Recording recording, cv::Size size, Stamp start);

  std::optional<Frame> latest(Stamp now) override;
  std::optional<DeviceError> error() const override { return error_; }
  std::optional<Stamp> next_stamp() const override;
  void rearm() override { error_.reset(); }

 private:
  std::string name_;
  Recording recording_;
  cv::Size size_;
  Stamp start_;
  std::size_t next_ = 0;
  std::optional<DeviceError> error_;
};

/// A video file at a steady rate, whatever stamps its container holds. Frames of another size than the rig's are an
/// error: they are never scaled.
class VideoCamera final : public RecordedCamera {
 public:
  /// `rate_hz` 0 takes the container's. A file that can not be played is a latched error.
  VideoCamera(std::string name, const std::string& path, double rate_hz, cv::Size size, Stamp start);
  ~VideoCamera() override;

  std::optional<Frame> latest(Stamp now) override;
  std::optional<DeviceError> error() const override { return error_; }
  std::optional<Stamp> next_stamp() const override;
  std::optional<std::uint64_t> promised_frames() const override;
  void rearm() override { error_.reset(); }

 private:
  void fail(const std::string& what);
  void grab();

  std::string name_;
  std::string path_;
  cv::Size size_;
  Stamp start_;
  double rate_hz_ = 0.0;
  std::unique_ptr<cv::VideoCapture> video_;
  std::uint64_t next_ = 0;
  bool grabbed_ = false;  ///< frame next_ waits to be decoded
  std::optional<DeviceError> error_;
};

}  // namespace hogline::hw::files
