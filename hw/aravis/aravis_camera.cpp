#include "hw/aravis/aravis_camera.hpp"

#include <utility>

#include "hw/aravis/aravis_source.hpp"

namespace hogline::hw {
namespace {

constexpr Duration turn = std::chrono::milliseconds(20);

Duration wall_now() { return std::chrono::system_clock::now().time_since_epoch(); }

}  // namespace

AravisCamera::AravisCamera(const AravisConfig& config, const Clock& clock)
    : AravisCamera(config, clock, std::make_unique<AravisSource>(config)) {}

AravisCamera::AravisCamera(const AravisConfig& config, const Clock& clock, std::unique_ptr<FrameSource> source)
    : config_(config),
      clock_(clock),
      source_(std::move(source)),
      feed_(*source_, config,
            [&clock] {
              return TimePair{clock.now(), wall_now()};
            }),
      thread_([this] { run(); }) {}

AravisCamera::~AravisCamera() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void AravisCamera::run() {
  for (;;) {
    auto frame = feed_.step(turn);
    std::unique_lock lock(mutex_);
    if (rearm_) feed_.rearm();
    rearm_ = false;
    if (frame) newest_ = std::move(frame);
    state_ = feed_.state();
    if (state_.phase == FeedPhase::closed) wake_.wait_for(lock, turn, [this] { return stopping_ || rearm_; });
    if (stopping_) return;
  }
}

std::optional<Frame> AravisCamera::latest(Stamp now) {
  const std::lock_guard lock(mutex_);
  if (!newest_ || newest_->stamp > now) return std::nullopt;
  return std::exchange(newest_, std::nullopt);
}

std::optional<DeviceError> AravisCamera::error() const {
  const std::lock_guard lock(mutex_);
  if (state_.error) return state_.error;
  const Stamp now = clock_.now();
  const bool silent =
      state_.phase == FeedPhase::streaming && now - state_.last_frame > config_.silence_limit + 2 * turn;
  if (silent && !stalled_) {
    stalled_ =
        DeviceError{DeviceErrorKind::timeout, config_.name, "no frame, and the camera library does not return", now};
  }
  return stalled_;
}

void AravisCamera::rearm() {
  const std::lock_guard lock(mutex_);
  rearm_ = true;
  state_.error.reset();
  stalled_.reset();
  wake_.notify_all();
}

FeedState AravisCamera::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

}  // namespace hogline::hw
