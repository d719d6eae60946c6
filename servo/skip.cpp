#include "servo/skip.hpp"

#include <utility>

#include "servo/skip_impl.hpp"

namespace hogline::servo {

const char* to_string(SkipState state) {
  switch (state) {
    case SkipState::boot:
      return "boot";
    case SkipState::look:
      return "look";
    case SkipState::aim:
      return "aim";
    case SkipState::wait:
      return "wait";
    case SkipState::follow:
      return "follow";
    case SkipState::done:
      return "done";
    case SkipState::stopped:
      return "stopped";
  }
  return "unknown";
}

Skip::Skip(const SkipConfig& config, const IceEstimate& ice, Stamp start)
    : impl_(std::make_unique<Impl>(config, ice, start)) {}
Skip::~Skip() = default;
Skip::Skip(Skip&&) noexcept = default;
Skip& Skip::operator=(Skip&&) noexcept = default;

SkipCommand Skip::step(const SkipObservation& observation, Duration dt) { return impl_->step(observation, dt); }
void Skip::expect(double spin_radps) { impl_->config.expected_spin_radps = spin_radps; }
void Skip::conclude(Stamp now) {
  if (finished()) return;
  if (!impl_->watch || !impl_->watch->at(now).thrown()) {
    impl_->stop(
        impl_->watch ? "no stone was seen to be thrown" : "sheet and stones were not seen: " + impl_->last_reason, now);
    return;
  }
  impl_->remarks.push_back("it ended before all lay still");
  impl_->finish(now);
}

SkipState Skip::state() const { return impl_->state; }
bool Skip::finished() const { return impl_->state == SkipState::done || impl_->state == SkipState::stopped; }
const SkipDiagnosis& Skip::diagnosis() const { return impl_->diagnosis; }
const CollisionWatch* Skip::watch() const { return impl_->watch ? &*impl_->watch : nullptr; }
const SkipReport& Skip::report() const { return impl_->report; }

SkipCommand Skip::Impl::step(const SkipObservation& o, Duration dt) {
  if (state == SkipState::done || state == SkipState::stopped) return {.head = SkipCommand::Head::stop};
  supervise(o);
  if (watch) take_in(o);
  SkipCommand command;
  switch (state) {
    case SkipState::boot:
      command = boot(o);
      break;
    case SkipState::look:
      command = look(o);
      break;
    case SkipState::aim:
      command = aim(o);
      break;
    case SkipState::wait:
      command = wait(o);
      break;
    case SkipState::follow:
      command = follow(o, dt);
      break;
    case SkipState::done:
    case SkipState::stopped:
      break;
  }
  if (head_lost && state != SkipState::boot) command.head = SkipCommand::Head::stop;
  return command;
}

// Device errors and ages. A head that stands where nobody knows is of no use to the far view.
void Skip::Impl::supervise(const SkipObservation& o) {
  if (o.head.error) lose_head(*o.head.error);
  if (state == SkipState::boot) return;
  if (o.now - o.head.joints.stamp > config.ages.head) lose_head("its angles are too old");
  if (state != SkipState::follow) return;
  if (o.now - pose_seen > config.ages.pose) lose_sight("the near view has not seen the sheet for too long");
  const bool far_needed = target(o.now).y_m > config.hand_over_y_m;
  if (far_needed && o.far_error) lose_head(*o.far_error);
  if (far_needed && o.now - far_seen > config.ages.far) lose_head("no picture of the far camera for too long");
}

void Skip::Impl::enter(SkipState next, Stamp now) {
  state = next;
  since = now;
}

SkipCommand Skip::Impl::stop(std::string why, Stamp now) {
  report.ok = false;
  report.reason = report.result.reason = std::move(why);
  report.remarks = remarks;
  enter(SkipState::stopped, now);
  return {.head = SkipCommand::Head::stop};
}

void Skip::Impl::finish(Stamp now) {
  report.result = result_of(watch->at(now), config.expected_spin_radps, watch->config().world, config.fit);
  report.remarks = remarks;
  report.ok = report.result.ok && remarks.empty();
  report.reason = !report.result.ok ? report.result.reason : remarks.empty() ? "" : remarks.front();
  enter(SkipState::done, now);
}

void Skip::Impl::lose_head(std::string why) {
  if (head_lost) return;
  head_lost = true;
  remarks.push_back("the head was stopped: " + std::move(why));
}

void Skip::Impl::lose_sight(std::string why) {
  if (sight_lost) return;
  sight_lost = true;
  lose_head(why);
  remarks.push_back("nothing was taken in after this: " + std::move(why));
}

}  // namespace hogline::servo
