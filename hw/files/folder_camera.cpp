#include <cassert>
#include <utility>

#include "hw/files/image_file.hpp"
#include "hw/files/recorded_camera.hpp"

namespace hogline::hw::files {

FolderCamera::FolderCamera(std::string name, Recording recording, cv::Size size, Stamp start)
    : name_(std::move(name)), recording_(std::move(recording)), size_(size), start_(start) {
  assert(recording_.problem.empty());
}

std::optional<Stamp> FolderCamera::next_stamp() const {
  if (next_ >= recording_.frames.size()) return std::nullopt;
  return start_ + recording_.frames[next_].time;
}

std::optional<Frame> FolderCamera::latest(Stamp now) {
  const auto& frames = recording_.frames;
  if (next_ >= frames.size() || start_ + frames[next_].time > now) return std::nullopt;
  while (next_ + 1 < frames.size() && start_ + frames[next_ + 1].time <= now) ++next_;
  const RecordedFrame& frame = frames[next_++];

  LoadedImage image = load_image(frame.path, size_);
  if (!image.error) return Frame{std::move(image.bgr), start_ + frame.time, frame.id};
  if (!error_) error_ = DeviceError{DeviceErrorKind::implausible, name_, image.error->message(), now};
  return std::nullopt;
}

}  // namespace hogline::hw::files
