#include "src/throwing/vision_thread.hpp"

#include <utility>

namespace hogline {
namespace {

// The loop asks each control period; a camera nobody asks is not watched.
constexpr Duration asked_lately = std::chrono::milliseconds(50);
constexpr auto pause = std::chrono::microseconds(500);

}  // namespace

std::optional<hw::Frame> VisionThread::Mailbox::latest(Stamp now) {
  const std::lock_guard lock(mutex_);
  asked_ = now;
  if (done_) handed_ = percept_;
  return std::exchange(done_, std::nullopt);
}

std::optional<hw::DeviceError> VisionThread::Mailbox::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

void VisionThread::Mailbox::rearm() {
  const std::lock_guard lock(mutex_);
  rearm_ = true;
  error_.reset();
}

SheetPosePercept VisionThread::Mailbox::percept(const vision::LowViewPrediction& hint) {
  const std::lock_guard lock(mutex_);
  hint_ = hint;
  return handed_;
}

bool VisionThread::Mailbox::wanted() const {
  const std::lock_guard lock(mutex_);
  return asked_ != Stamp{} && clock_.now() - asked_ < asked_lately;
}

std::optional<hw::Frame> VisionThread::Mailbox::take() {
  bool rearm = false;
  {
    const std::lock_guard lock(mutex_);
    rearm = std::exchange(rearm_, false);
  }
  if (rearm) camera_.rearm();
  auto frame = camera_.latest(clock_.now());
  const std::lock_guard lock(mutex_);
  error_ = camera_.error();
  return frame;
}

vision::LowViewPrediction VisionThread::Mailbox::hint() const {
  const std::lock_guard lock(mutex_);
  return hint_;
}

void VisionThread::Mailbox::deliver(const hw::Frame& frame, SheetPosePercept percept) {
  const std::lock_guard lock(mutex_);
  done_ = hw::Frame{.bgr = {}, .stamp = frame.stamp, .id = frame.id};
  percept_ = std::move(percept);
}

VisionThread::VisionThread(SheetSeer& seer, hw::Camera& near_camera, hw::Camera& low_camera, const hw::Clock& clock,
                           std::function<void()> at_begin)
    : seer_(seer),
      clock_(clock),
      near_(near_camera, clock),
      low_(low_camera, clock),
      mailbox_seer_(near_, low_),
      thread_([this, begin = std::move(at_begin)](const std::stop_token& stop) {
        if (begin) begin();
        run(stop);
      }) {}

VisionThread::~VisionThread() = default;

void VisionThread::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Mailbox& box = low_.wanted() ? low_ : near_;
    const Stamp begun = clock_.now();
    const auto frame = box.wanted() ? box.take() : std::nullopt;
    if (!frame) {
      std::this_thread::sleep_for(pause);
      continue;
    }
    box.deliver(*frame, &box == &near_ ? seer_.near_view(*frame) : seer_.low_view(*frame, low_.hint()));
    ++looks_;
    // Whoever runs before all others leaves them some of the time.
    std::this_thread::sleep_for((clock_.now() - begun) / 8);
  }
}

}  // namespace hogline
