#include "hw/checks/checked_camera.hpp"

#include <cassert>
#include <cstdio>
#include <utility>

namespace hogline::hw {
namespace {

std::string in_ms(const char* before, Duration span, const char* after) {
  char text[160];
  std::snprintf(text, sizeof(text), "%s%.0f ms%s", before, 1e3 * seconds(span), after);
  return text;
}

}  // namespace

CheckedCamera::CheckedCamera(Camera& camera, CameraWatch watch)
    : camera_(camera), watch_(std::move(watch)), check_(watch_.picture) {
  assert(watch_.max_age > Duration{} && watch_.silence_limit > Duration{});
}

void CheckedCamera::note_asking(Stamp now) {
  const auto paused = [&](Duration limit) { return !last_asked_ || now - *last_asked_ > limit; };
  if (paused(watch_.max_age)) last_frame_ = now;  // nobody asked: that was no silence of the camera's
  if (paused(watch_.silence_limit)) {
    asking_since_ = now;
    check_.forget();
  }
  last_asked_ = now;
}

void CheckedCamera::watch_silence(Stamp now) {
  const Duration limit = ever_ ? watch_.silence_limit : watch_.first_frame_limit;
  if (now - last_frame_ <= limit) return;
  fail({DeviceErrorKind::timeout, in_ms("no frame for ", now - last_frame_, "; check its power, cable and load")}, now);
}

std::optional<CheckedCamera::Problem> CheckedCamera::problem_of(const Frame& frame, Stamp now) {
  using Kind = DeviceErrorKind;
  if (frame.stamp > now) {
    return Problem{Kind::implausible, in_ms("a frame's stamp lies ", frame.stamp - now, " ahead; check the clocks")};
  }
  if (newest_stamp_ && frame.stamp <= *newest_stamp_) {
    return Problem{Kind::implausible, in_ms("a frame's stamp lies ", *newest_stamp_ - frame.stamp,
                                            " before the last one's; the camera repeats itself or its clock jumped")};
  }
  if (newest_stamp_ && frame.id <= newest_id_) return Problem{Kind::implausible, "frame numbers go back"};
  if (now - frame.stamp > watch_.max_age) {
    return Problem{Kind::timeout,
                   in_ms("a frame came ", now - frame.stamp, " after its exposure; check link and load")};
  }
  verdict_ = check_.check(frame.bgr);
  if (!verdict_->fault) return std::nullopt;
  return Problem{Kind::implausible, "the picture is " + verdict_->describe() + "; check lens, cover and exposure"};
}

std::optional<Frame> CheckedCamera::latest(Stamp now) {
  const std::optional<Stamp> asked_before = last_asked_;
  note_asking(now);
  auto frame = camera_.latest(now);
  if (!frame) {
    watch_silence(now);
    return std::nullopt;
  }
  ever_ = true;
  // One that was not late when it was last asked for may have waited for us ever since: too old to be used, and
  // nobody's fault but ours. It breaks no silence: a camera that is always a little late is found out by that.
  const bool is_next = !newest_stamp_ || frame->stamp > *newest_stamp_;
  const bool waited_for_us =
      is_next && now - frame->stamp > watch_.max_age && asked_before && *asked_before - frame->stamp <= watch_.max_age;
  if (!waited_for_us) last_frame_ = now;
  if (frame->stamp < asking_since_ || waited_for_us) {
    ++counters_.too_soon;
    return std::nullopt;
  }
  auto problem = problem_of(*frame, now);
  newest_stamp_ = frame->stamp;
  newest_id_ = frame->id;
  if (problem) {
    ++counters_.refused;
    fail(std::move(*problem), now);
    return std::nullopt;
  }
  ++counters_.given;
  return frame;
}

std::optional<DeviceError> CheckedCamera::error() const { return error_ ? error_ : camera_.error(); }

void CheckedCamera::rearm() {
  camera_.rearm();
  error_.reset();
  last_asked_.reset();
  newest_stamp_.reset();
  ever_ = false;
  check_.forget();
}

void CheckedCamera::fail(Problem problem, Stamp now) {
  if (!error_) error_ = DeviceError{problem.kind, watch_.name, std::move(problem.what), now};
}

}  // namespace hogline::hw
