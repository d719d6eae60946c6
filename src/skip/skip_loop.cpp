#include "src/skip/skip_loop.hpp"

#include <algorithm>
#include <utility>

namespace hogline {
namespace {

constexpr Duration remembered = std::chrono::seconds(1);

std::string words_of(const hw::DeviceError& e) { return e.device + ": " + e.what; }

std::optional<std::string> error_of(const hw::Camera& camera) {
  const auto error = camera.error();
  return error ? std::optional(words_of(*error)) : std::nullopt;
}

}  // namespace

SkipLoop::SkipLoop(const SkipDevices& devices, SkipSeer& seer, servo::Skip skip)
    : devices_(devices), seer_(seer), skip_(std::move(skip)) {}

void SkipLoop::step(Stamp now, Duration dt) {
  devices_.head.step(now);
  servo::SkipObservation observation = observe(now);
  see(observation, now);
  observation.release = std::exchange(heard_, std::nullopt);
  command_ = skip_.step(observation, dt);
  apply(now);
}

servo::SkipObservation SkipLoop::observe(Stamp now) {
  const hw::HeadState state = devices_.head.state();
  servo::SkipObservation o;
  o.now = now;
  o.head.ready = state.phase == hw::DrivePhase::ready || state.phase == hw::DrivePhase::stopped;
  o.head.enabled = state.phase == hw::DrivePhase::enabled;
  o.head.on_target = state.on_target;
  if (state.error) o.head.error = words_of(*state.error);
  o.head.joints = {
      state.stamp, {state.measured.pan_rad, state.measured.tilt_rad}, state.rate.pan_radps, state.rate.tilt_radps};
  if (joints_.empty() || state.stamp > joints_.back().stamp) joints_.push_back(o.head.joints);
  while (joints_.size() > 2 && joints_.front().stamp < now - remembered) joints_.pop_front();
  return o;
}

// A frame whose head angles nobody knows is not looked at.
void SkipLoop::see(servo::SkipObservation& o, Stamp now) {
  if (command_.near_wanted) {
    const auto frame = devices_.near.latest(now);
    const auto q = frame ? angles_at(frame->stamp) : std::nullopt;
    if (q) o.near = seer_.near_view(*frame, *q, skip_.diagnosis());
    near_frames_ += q ? 1 : 0;
  }
  if (command_.far_wanted) {
    const auto frame = devices_.far.latest(now);
    const auto q = frame ? angles_at(frame->stamp) : std::nullopt;
    if (q) o.far = seer_.far_view(*frame, *q, skip_.diagnosis());
    far_frames_ += q ? 1 : 0;
  }
  o.near_error = error_of(devices_.near);
  o.far_error = error_of(devices_.far);
}

std::optional<servo::HeadAngles> SkipLoop::angles_at(Stamp stamp) const {
  if (joints_.empty() || stamp < joints_.front().stamp ||
      stamp > joints_.back().stamp + std::chrono::milliseconds(30)) {
    return std::nullopt;
  }
  const auto next = std::find_if(joints_.begin(), joints_.end(), [&](const auto& j) { return j.stamp >= stamp; });
  if (next == joints_.end() || next == joints_.begin()) {
    const servo::HeadJoints& j = next == joints_.end() ? joints_.back() : joints_.front();
    const double ahead_s = seconds(stamp - j.stamp);
    return servo::HeadAngles{j.angles.pan_rad + ahead_s * j.pan_radps, j.angles.tilt_rad + ahead_s * j.tilt_radps};
  }
  const servo::HeadJoints &a = *std::prev(next), &b = *next;
  const double u = seconds(stamp - a.stamp) / seconds(b.stamp - a.stamp);
  return servo::HeadAngles{a.angles.pan_rad + u * (b.angles.pan_rad - a.angles.pan_rad),
                           a.angles.tilt_rad + u * (b.angles.tilt_rad - a.angles.tilt_rad)};
}

void SkipLoop::apply(Stamp now) {
  switch (command_.head) {
    case servo::SkipCommand::Head::none:
      return;
    case servo::SkipCommand::Head::enable:
      return devices_.head.enable();
    case servo::SkipCommand::Head::point:
      return devices_.head.point({command_.target.pan_rad, command_.target.tilt_rad}, now);
    case servo::SkipCommand::Head::track:
      return devices_.head.track({command_.pan_radps, command_.tilt_radps}, now);
    case servo::SkipCommand::Head::stop:
      return devices_.head.stop();
  }
}

}  // namespace hogline
