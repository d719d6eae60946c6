#include "src/live/live_thrower.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <utility>

#include "src/live/process.hpp"

namespace hogline {
namespace {

constexpr Duration arming_limit = std::chrono::seconds(15);  // two boots of the drives
constexpr Duration same_refusal = std::chrono::seconds(1);
constexpr Duration load_period = std::chrono::milliseconds(1500);

}  // namespace

const char* to_string(LivePhase phase) {
  switch (phase) {
    case LivePhase::disarmed:
      return "disarmed";
    case LivePhase::arming:
      return "arming";
    case LivePhase::armed:
      return "armed";
    case LivePhase::throwing:
      return "throwing";
  }
  return "";
}

/// The operator's switch, which the thrower sees held only while it is armed.
class LiveThrower::ArmedSwitch final : public hw::OperatorSwitch {
 public:
  ArmedSwitch(hw::OperatorSwitch& hand, Duration max_age) : hand_(hand), max_age_(max_age) {}
  void step(Stamp now) override { hand_.step(now); }
  hw::OperatorSwitchState state() const override {
    const hw::OperatorSwitchState hand = hand_.state();
    return {.held = hand.held && armed_, .stamp = hand.stamp};
  }
  bool pressed(Stamp now) const { return hand_.state().held && now - hand_.state().stamp <= max_age_; }
  void arm(bool armed) { armed_ = armed; }

 private:
  hw::OperatorSwitch& hand_;
  Duration max_age_;
  bool armed_ = false;
};

/// In the thread that looks: a seer of its own for each throw, so that nothing is followed from one to the next.
class LiveThrower::FreshSeer final : public SheetSeer {
 public:
  explicit FreshSeer(MakeSeer make) : make_(std::move(make)) {}
  void forget() { fresh_ = true; }
  SheetPosePercept near_view(const hw::Frame& frame) override { return seer().near_view(frame); }
  SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) override {
    return seer().low_view(frame, hint);
  }

 private:
  SheetSeer& seer() {
    if (fresh_.exchange(false) || !seer_) seer_ = make_();
    return *seer_;
  }

  MakeSeer make_;
  std::atomic<bool> fresh_ = false;
  std::unique_ptr<SheetSeer> seer_;
};

namespace {

/// What the thread that looks has seen, as a seer.
class DoneLooks final : public SheetSeer {
 public:
  explicit DoneLooks(SheetSeer& done) : done_(done) {}
  SheetPosePercept near_view(const hw::Frame& frame) override { return done_.near_view(frame); }
  SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction& hint) override {
    return done_.low_view(frame, hint);
  }

 private:
  SheetSeer& done_;
};

// A look that comes out of its thread is done.
config::ThrowerRig without_look_times(config::ThrowerRig rig) {
  rig.looks = {};
  return rig;
}

}  // namespace

LiveThrower::LiveThrower(const config::ThrowerRig& rig, const ThrowerDevices& d, hw::TeamLink& link, MakeSeer make_seer,
                         Tell tell)
    : tell_(std::move(tell)),
      gyro_(d.gyro),
      drive_(d.drive),
      switch_(std::make_unique<ArmedSwitch>(d.operator_switch, rig.thrower.safety.operator_age)),
      seer_(std::make_unique<FreshSeer>(std::move(make_seer))),
      looking_(*seer_, d.near_camera, d.low_camera, d.clock, [] { run_first(look_priority); }),
      member_(std::make_unique<ThrowerMember>(
          without_look_times(rig),
          ThrowerDevices{d.drive, d.gripper, d.arm, d.gyro, looking_.near_camera(), looking_.low_camera(), *switch_,
                         d.clock},
          [this]() -> std::unique_ptr<SheetSeer> {
            seer_->forget();
            return std::make_unique<DoneLooks>(looking_.seer());
          },
          link)) {}

LiveThrower::~LiveThrower() = default;

void LiveThrower::step(Stamp now, Duration dt) {
  member_->step(now, dt);
  if (phase_ == LivePhase::throwing || member_->throwing()) return watch_throw();
  watch_switch(now);
  tell_refusals(now);
  tell_readiness();
  if (phase_ == LivePhase::arming) step_arming(now);
  if (phase_ != LivePhase::armed) return;
  if (const std::string problem = not_ready(now); !problem.empty()) enter(LivePhase::disarmed, problem);
}

// Also who waits says when a device is lost, or back.
void LiveThrower::tell_readiness() {
  switch_->arm(true);
  const std::string problem = member_->not_ready();
  switch_->arm(phase_ == LivePhase::armed);
  if (problem == told_problem_ || phase_ != LivePhase::disarmed) return;
  told_problem_ = problem;
  tell_(problem.empty() ? "ready" : "not ready", problem);
}

// One more order than are known of, and no throw: whoever stands beside the robot shall know why; not fifty times a
// second.
void LiveThrower::tell_refusals(Stamp now) {
  const bool news = member_->refused() != told_refusal_ || now >= next_refusal_;
  if (member_->orders() != known_orders_ && !member_->refused().empty() && news) {
    told_refusal_ = member_->refused();
    next_refusal_ = now + same_refusal;
    tell_("order refused", told_refusal_);
  }
  known_orders_ = member_->orders();
}

void LiveThrower::end() {
  ended_ = true;
  switch_->arm(false);
}

// ---- arming ----

void LiveThrower::watch_switch(Stamp now) {
  if (!switch_->pressed(now)) {
    seen_free_ = true;
    if (phase_ != LivePhase::disarmed) enter(LivePhase::disarmed, "the operator's switch was let go");
    return;
  }
  if (phase_ != LivePhase::disarmed || !seen_free_ || ended_) return;
  seen_free_ = false;
  arming_since_ = now;
  next_load_ = now;
  enter(LivePhase::arming, {});
}

// Devices that were away come back one after the other: each is given time, and asked again.
void LiveThrower::step_arming(Stamp now) {
  const std::string problem = not_ready(now);
  if (problem.empty()) return enter(LivePhase::armed, {});
  if (now - arming_since_ > arming_limit) return enter(LivePhase::disarmed, "not armed: " + problem);
  if (now < next_load_) return;
  next_load_ = now + load_period;
  member_->load();
}

// The member is asked as if it were armed already: all but the switch must be well.
std::string LiveThrower::not_ready(Stamp now) const {
  switch_->arm(true);
  std::string problem = member_->not_ready();
  switch_->arm(phase_ == LivePhase::armed);
  if (problem.empty() && !switch_->pressed(now)) problem = "the operator's switch was let go";
  if (problem.empty()) problem = member_->missing(now);
  if (problem.empty() && !gyro_.state().valid) problem = "nothing is known of the gyro";
  return problem;
}

void LiveThrower::enter(LivePhase phase, const std::string& why) {
  phase_ = phase;
  switch_->arm(phase == LivePhase::armed || phase == LivePhase::throwing);
  tell_(to_string(phase), why);
}

// ---- the throw ----

void LiveThrower::watch_throw() {
  const servo::Thrower& thrower = member_->loop()->thrower();
  if (phase_ != LivePhase::throwing) {
    told_state_.reset();
    told_abort_.clear();
    told_release_ = false;
    enter(LivePhase::throwing, {});
  }
  if (ended_) switch_->arm(false);
  if (told_state_ != thrower.state()) tell_("state", servo::to_string(thrower.state()));
  told_state_ = thrower.state();
  const std::string abort = thrower.abort_reason().value_or("");
  if (told_abort_ != abort) tell_("aborted", abort);
  told_abort_ = abort;
  if (const auto& freed = thrower.diagnosis().freed; freed && !told_release_) {
    told_release_ = true;
    tell_("released", fmt::format("at {:.3f} m/s, {:.3f} m from the tee", freed->speed_mps, freed->y_m));
  }
  if (member_->throwing()) return;
  for (const hw::DeviceError& error : member_->loop()->device_errors())
    tell_("device error", fmt::format("{}: {}: {}", error.device, to_string(error.kind), error.what));
  seen_free_ = false;
  enter(LivePhase::disarmed, thrower.released() ? "the stone was let go" : "the stone was kept: " + abort);
}

}  // namespace hogline
