#include "src/live/skip_eyes_thread.hpp"

#include <algorithm>
#include <utility>

#include "src/live/process.hpp"

namespace hogline {
namespace {

constexpr Duration asked_lately = std::chrono::milliseconds(50);
constexpr Duration remembered = std::chrono::seconds(1);
constexpr auto pause = std::chrono::milliseconds(1);

}  // namespace

std::optional<hw::Frame> SkipEyesThread::Box::latest(Stamp now) {
  const std::lock_guard lock(eyes_.mutex_);
  asked_ = now;
  if (done_) hand_out_();
  return std::exchange(done_, std::nullopt);
}

std::optional<hw::DeviceError> SkipEyesThread::Box::error() const {
  const std::lock_guard lock(eyes_.mutex_);
  return error_;
}

void SkipEyesThread::Box::rearm() {
  const std::lock_guard lock(eyes_.mutex_);
  rearm_ = true;
  error_.reset();
}

std::optional<hw::Frame> SkipEyesThread::Box::take() {
  bool rearm = false;
  {
    const std::lock_guard lock(eyes_.mutex_);
    if (asked_ == Stamp{} || eyes_.clock_.now() - asked_ > asked_lately) return std::nullopt;
    rearm = std::exchange(rearm_, false);
  }
  if (rearm) camera_.rearm();
  auto frame = camera_.latest(eyes_.clock_.now());
  const std::lock_guard lock(eyes_.mutex_);
  error_ = camera_.error();
  return frame;
}

void SkipEyesThread::Box::deliver(const hw::Frame& frame) {
  done_ = hw::Frame{.bgr = {}, .stamp = frame.stamp, .id = frame.id};
}

SkipEyesThread::SkipEyesThread(MakeSeer make_seer, hw::Camera& near, hw::Camera& far, const hw::Clock& clock)
    : make_seer_(std::move(make_seer)),
      seer_(make_seer_()),
      clock_(clock),
      near_(*this, near, [this] { seen_.handed.near = sights_.near; }),
      far_(*this, far, [this] { seen_.handed.far = sights_.far; }),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

SkipEyesThread::~SkipEyesThread() = default;

void SkipEyesThread::forget() {
  const std::lock_guard lock(mutex_);
  known_ = {.diagnosis = {}, .throws = known_.throws + 1};
  near_.forget();
  far_.forget();
}

// In the thread that looks.
SkipEyesThread::Known SkipEyesThread::known() {
  Known known;
  {
    const std::lock_guard lock(mutex_);
    known = known_;
  }
  if (std::exchange(seer_of_, known.throws) != known.throws) seer_ = make_seer_();
  return known;
}

void SkipEyesThread::note(const hw::HeadState& head, const servo::SkipDiagnosis& known) {
  const std::lock_guard lock(mutex_);
  known_.diagnosis = known;
  if (heads_.empty() || head.stamp > heads_.back().stamp) heads_.push_back(head);
  while (heads_.size() > 2 && heads_.front().stamp < head.stamp - remembered) heads_.pop_front();
}

// As SkipLoop has it: between two readings all motion is even.
std::optional<servo::HeadAngles> SkipEyesThread::angles_at(Stamp stamp) const {
  const std::lock_guard lock(mutex_);
  if (heads_.empty() || stamp < heads_.front().stamp) return std::nullopt;
  const auto next = std::ranges::lower_bound(heads_, stamp, {}, &hw::HeadState::stamp);
  const hw::HeadState& h = next == heads_.end() ? heads_.back() : *next;
  const double ahead_s = seconds(stamp - h.stamp);
  return servo::HeadAngles{h.measured.pan_rad + ahead_s * h.rate.pan_radps,
                           h.measured.tilt_rad + ahead_s * h.rate.tilt_radps};
}

void SkipEyesThread::run(const std::stop_token& stop) {
  run_first(look_priority);
  while (!stop.stop_requested()) {
    const bool far = look_far();
    const bool near = look_near();
    if (!far && !near) std::this_thread::sleep_for(pause);
  }
}

bool SkipEyesThread::look_near() { return look(near_, sights_.near, &SkipSeer::near_view); }

bool SkipEyesThread::look_far() { return look(far_, sights_.far, &SkipSeer::far_view); }

// What was looked at for a throw that is over by then is nobody's.
template <typename Sight>
bool SkipEyesThread::look(Box& box, Sight& seen, View<Sight> view) {
  const auto frame = box.take();
  const auto q = frame ? angles_at(frame->stamp) : std::nullopt;
  if (!q) return false;
  const Known known = this->known();
  Sight sight = (*seer_.*view)(*frame, *q, known.diagnosis);
  const std::lock_guard lock(mutex_);
  if (known.throws != known_.throws) return true;
  seen = std::move(sight);
  box.deliver(*frame);
  return true;
}

}  // namespace hogline
