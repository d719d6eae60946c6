#include <cmath>
#include <filesystem>
#include <opencv2/videoio.hpp>
#include <utility>

#include "hw/files/recorded_camera.hpp"

namespace hogline::hw::files {
namespace {

std::string text(cv::Size size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

}  // namespace

VideoCamera::VideoCamera(std::string name, const std::string& path, double rate_hz, cv::Size size, Stamp start)
    : name_(std::move(name)),
      path_(path),
      size_(size),
      start_(start),
      rate_hz_(rate_hz),
      video_(std::make_unique<cv::VideoCapture>()) {
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(path, unreadable)) {
    fail("no such file");
    return;
  }
  if (!video_->open(path, cv::CAP_FFMPEG)) {
    fail("can not be played: it is no video, or its end is missing");
    return;
  }
  video_->set(cv::CAP_PROP_ORIENTATION_AUTO, 0);  // turning a picture by its tag would change the lens
  if (rate_hz_ == 0.0) rate_hz_ = video_->get(cv::CAP_PROP_FPS);
  if (!(std::isfinite(rate_hz_) && rate_hz_ > 0.0 && rate_hz_ <= 1000.0)) {
    fail("has no usable frame rate");
    return;
  }
  grab();
  if (!grabbed_) fail("holds no frame");
}

VideoCamera::~VideoCamera() = default;

void VideoCamera::fail(const std::string& what) {
  if (!error_) error_ = DeviceError{DeviceErrorKind::implausible, name_, path_ + ": " + what, start_};
}

void VideoCamera::grab() { grabbed_ = video_->grab(); }

std::optional<Stamp> VideoCamera::next_stamp() const {
  if (!grabbed_) return std::nullopt;
  return start_ + from_seconds(static_cast<double>(next_) / rate_hz_);
}

std::optional<std::uint64_t> VideoCamera::promised_frames() const {
  const double count = video_->isOpened() ? video_->get(cv::CAP_PROP_FRAME_COUNT) : 0.0;
  if (!(count >= 1.0 && count < 1e12)) return std::nullopt;
  return static_cast<std::uint64_t>(count);
}

std::optional<Frame> VideoCamera::latest(Stamp now) {
  std::optional<Frame> newest;
  while (grabbed_ && *next_stamp() <= now) {
    cv::Mat picture;
    if (video_->retrieve(picture)) {
      newest = Frame{picture.clone(), *next_stamp(), next_};  // the capture uses its memory again
    } else {
      fail("a frame can not be decoded");
    }
    ++next_;
    grab();
  }
  if (!newest) return std::nullopt;
  if (newest->bgr.size() == size_ && newest->bgr.type() == CV_8UC3) return newest;
  fail("is " + text(newest->bgr.size()) + " pixels, the rig's camera has " + text(size_) +
       "; use the camera's own recording, neither scaled nor cropped, or correct width_px and height_px");
  return std::nullopt;
}

}  // namespace hogline::hw::files
