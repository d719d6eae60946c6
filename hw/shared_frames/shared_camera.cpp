#include "hw/shared_frames/shared_camera.hpp"

#include <cstring>
#include <utility>

namespace hogline::hw {
namespace {

constexpr Duration look_period = std::chrono::milliseconds(50);
constexpr int attempts = 3;

}  // namespace

std::optional<Frame> SharedCamera::latest(Stamp now) {
  note_asking(now);
  if (!ring_ && !connect(now)) return std::nullopt;
  ring_->header().asked_ns = now.time_since_epoch().count();
  if (!alive(now)) return std::nullopt;
  for (int i = 0; i < attempts; ++i) {
    const std::uint64_t count = ring_->header().newest_count.load(std::memory_order_acquire);
    if (count <= given_) return std::nullopt;
    auto frame = copy(count - 1);
    if (!frame) continue;
    given_ = count;
    frame->id += id_offset_;
    last_id_ = frame->id;
    return frame;
  }
  return std::nullopt;
}

// Whoever asks again after a pause may find another writer: that is no loss, for nobody was looking.
void SharedCamera::note_asking(Stamp now) {
  const bool paused = last_asked_ && now - *last_asked_ > config_.silence_limit;
  last_asked_ = now;
  if (!paused && asked_since_) return;
  asked_since_ = now;
  next_look_ = Stamp{};
  if (!error_) ring_.reset();
}

// A latched error keeps the pictures back; a writer is looked for only afterwards, so that his coming is no surprise.
bool SharedCamera::connect(Stamp now) {
  if (error_ || now < next_look_) return false;
  next_look_ = now + look_period;
  std::string problem;
  ring_ = FrameRingMapping::open(config_.segment, problem);
  if (!ring_) {
    if (now - *asked_since_ > config_.first_limit) {
      fail(DeviceErrorKind::disconnected, "shared memory " + config_.segment + ": " + problem, now);
    }
    return false;
  }
  const FrameRingHeader& header = ring_->header();
  const Stamp beat{Duration{header.beat_ns.load()}};
  if (now - beat > config_.silence_limit) {  // what a dead writer left
    ring_.reset();
    if (now - *asked_since_ > config_.first_limit) {
      fail(DeviceErrorKind::disconnected, "shared memory " + config_.segment + ": nobody writes into it", now);
    }
    return false;
  }
  given_ = header.newest_count.load(std::memory_order_acquire);  // what was written for others is old
  channels_ = header.shape.channels;
  id_offset_ = last_id_;
  if (header.shape.width_px == config_.width_px && header.shape.height_px == config_.height_px) return true;
  fail(DeviceErrorKind::protocol,
       "pictures of " + std::to_string(header.shape.width_px) + " x " + std::to_string(header.shape.height_px) +
           " pixels, and the rig says " + std::to_string(config_.width_px) + " x " + std::to_string(config_.height_px),
       now);
  ring_.reset();
  return false;
}

bool SharedCamera::alive(Stamp now) {
  const Stamp beat{Duration{ring_->header().beat_ns.load()}};
  if (now - beat <= config_.silence_limit) return true;
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now - beat).count();
  fail(
      DeviceErrorKind::disconnected,
      beat == Stamp{} ? "its program has ended" : "its program has not been heard of for " + std::to_string(ms) + " ms",
      now);
  ring_.reset();
  return false;
}

std::optional<Frame> SharedCamera::copy(std::uint64_t number) const {
  const FrameSlotHeader& slot = ring_->slot(number);
  const std::uint64_t before = slot.count.load(std::memory_order_acquire);
  if (before % 2 != 0) return std::nullopt;
  Frame frame;
  frame.bgr.create(static_cast<int>(config_.height_px), static_cast<int>(config_.width_px),
                   channels_ == 3 ? CV_8UC3 : CV_8UC1);
  std::memcpy(frame.bgr.data, ring_->picture(number), frame.bgr.total() * frame.bgr.elemSize());
  frame.stamp = Stamp{Duration{slot.stamp_ns}};
  frame.id = slot.id;
  std::atomic_thread_fence(std::memory_order_acquire);
  if (slot.count.load(std::memory_order_relaxed) != before) return std::nullopt;
  return frame;
}

void SharedCamera::rearm() {
  error_.reset();
  asked_since_.reset();
  last_asked_.reset();
  next_look_ = Stamp{};
}

void SharedCamera::fail(DeviceErrorKind kind, std::string what, Stamp now) {
  if (!error_) error_ = DeviceError{kind, config_.name, std::move(what), now};
}

}  // namespace hogline::hw
