#include "src/faults/fault_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/faults/posture.hpp"
#include "src/faults/trial_request.hpp"
#include "src/faults/trial_verdict.hpp"
#include "src/throwing/throw_judge.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::faults {
namespace {

using namespace std::chrono_literals;
using servo::ThrowerState;

constexpr double full_speed_share = 0.98;
constexpr Duration throw_limit = 60s;
constexpr Duration recovery_time = 3s;
constexpr double standing_mps = 0.01;
constexpr double standing_radps = 0.02;
constexpr const char* first_fault = "gyro";  // that makes the robot brake, where there are two

std::optional<hw::DeviceError> first_error(const ThrowerDevices& d) {
  for (const auto& error : {d.drive.state().error, d.gripper.state().error, d.arm.state().error, d.gyro.state().error,
                            d.near_camera.error(), d.low_camera.error()}) {
    if (error) return error;
  }
  return std::nullopt;
}

class Trial {
 public:
  explicit Trial(const Case& fault) : Trial(fault, request_of(fault)) {}
  Trial(const Case& fault, ThrowRequest request)
      : case_(fault),
        request_(std::move(request)),
        robot_(request_.rig, request_.scenario),
        site_{.robot = robot_, .stranger = robot_.rink().bus().make_endpoint(), .each_ms = {}, .set_point = {}},
        period_(request_.rig.drive.timing.control_period),
        seer_(oracle_of(robot_, request_.rig)) {}

  Trial(const Case& fault, const Moment& moment) : Trial(fault, request_of(fault, moment)) { after_ = moment.after; }

  Struck run_on() {
    power_on();
    carry_out_throw();
    note_end();
    const auto& release = finding_.result.release;
    return {.struck = struck_.has_value(),
            .state = state_at_strike_,
            .room_m = room_m_,
            .standing = standing(),
            .set_down = truth().set_down.has_value(),
            .release_error_m = release ? release->hog_distance_m - release->target_hog_distance_m : 0.0,
            .release_limit_m = request_.rig.thrower.release.tolerance_m,
            .finding = finding_};
  }

  Finding run() {
    power_on();
    carry_out_throw();
    note_end();
    if (case_.expect != Expect::goes_on) {
      recover();
      rearm();
    }
    judge(case_, struck_.has_value(), finding_);
    return finding_;
  }

 private:
  void power_on();
  void carry_out_throw();
  void strike_when_due();
  void strike();
  void listen();
  void watch();
  void note_end();
  void recover();
  void rearm();
  std::string log() const;
  void period();
  void pass(Duration span);
  bool due() const;
  std::optional<Stamp> since(ThrowerState state) const;
  const hw::sim::Truth& truth() const { return robot_.rink().truth(); }
  Stamp now() const { return robot_.rink().now(); }
  bool standing() const;

  const Case& case_;
  ThrowRequest request_;
  SimulatedRobot robot_;
  Site site_;
  Duration period_;
  OracleSeer seer_;
  std::optional<ThrowerLoop> loop_;
  std::optional<ThrowJudge> judge_;
  Finding finding_;
  Stamp last_step_{};
  std::optional<Stamp> first_struck_;  ///< of two faults
  std::optional<Stamp> struck_;
  std::optional<Stamp> detected_;
  std::optional<Stamp> stood_;
  PlanarPose last_place_;
  bool healed_ = false;
  std::optional<Duration> after_;  ///< the throw's beginning: strikes then, whatever the case says
  Stamp begin_{};
  ThrowerState state_at_strike_{};
  double room_m_ = 0.0;
  std::string emergency_;  ///< the first EMCY on the bus while the program does not run
};

void Trial::power_on() {
  listen();
  if (case_.strike == Strike::power_on) strike();
  boot(robot_, period_);
  last_step_ = now();
  const auto error = first_error(robot_.devices());
  if (struck_ && error && case_.expect == Expect::does_not_start) {
    detected_ = error->since;
  }
  loop_.emplace(robot_.devices(), ThrowerEyes(seer_, request_.rig.looks),
                servo::Thrower(request_.rig.thrower, request_.order, now()), servo::Supervisor(request_.rig.thrower));
  loop_->arm(now());
  begin_ = now();
  judge_.emplace(request_.rig.thrower, robot_.scenario(), request_.order, now());
}

// One control period of the rink, and of the program unless it is held up.
void Trial::period() {
  for (Duration left = period_ + std::exchange(site_.loop_late, Duration{}); left > Duration{}; left -= 1ms) {
    if (site_.each_ms) site_.each_ms();
    if (loop_ && !site_.loop_dead) {
      pass_period(robot_.rink(), *loop_, std::min<Duration>(left, 1ms));
    } else {
      robot_.rink().step(std::min<Duration>(left, 1ms));
    }
  }
  if (site_.loop_dead) return;
  loop_->step(now(), now() - last_step_);
  last_step_ = now();
  if (site_.set_point) robot_.devices().drive.command(*std::exchange(site_.set_point, std::nullopt), now());
}

void Trial::pass(Duration span) {
  for (const Stamp end = now() + span; now() < end;) period();
}

std::optional<Stamp> Trial::since(ThrowerState state) const {
  for (const auto& entry : loop_->thrower().history()) {
    if (entry.state == state) return entry.since;
  }
  return std::nullopt;
}

bool Trial::due() const {
  if (after_) return now() - begin_ >= *after_;
  const auto passed = [&](ThrowerState state, Duration span) {
    const auto entered = since(state);
    return entered && now() - *entered >= span;
  };
  const bool fast = since(ThrowerState::run) && truth().twist.forward_mps >= full_speed_share * trial_speed_mps;
  switch (case_.strike) {
    case Strike::power_on:
      return false;
    case Strike::rehearsing:
      return passed(ThrowerState::rehearse, 20ms) && loop_->command().gripper.trial == servo::JawTrial::open;
    case Strike::set_down:
      return truth().set_down.has_value();
    case Strike::measuring:
      return passed(ThrowerState::measure, 300ms);
    case Strike::aligning:
      return passed(ThrowerState::align, 300ms);
    case Strike::speeding_up:
      return passed(ThrowerState::run, 1s);
    case Strike::full_speed:
      return fast;
    case Strike::braking:
      return first_struck_ && passed(ThrowerState::brake, 100ms);
    case Strike::too_late:
      return fast && vision::rules::tee_to_hog_m - truth().body.y_m < 0.9;
    case Strike::released:
      return since(ThrowerState::release).has_value() && !loop_->release_due();
  }
  return false;
}

void Trial::listen() {
  robot_.rink().bus().set_tap([this](const hw::StampedCanFrame& seen) {
    const bool cry =
        seen.frame.id > 0x080 && seen.frame.id < 0x100 && (seen.frame.data[0] != 0 || seen.frame.data[1] != 0);
    if (!cry || !site_.loop_dead || !emergency_.empty()) return;
    const int code = seen.frame.data[0] | seen.frame.data[1] << 8;
    emergency_ = fmt::format("on the bus: EMCY {:04X} of node {}", code, seen.frame.id - 0x080);
  });
}

void Trial::strike() {
  finding_.speed_mps = truth().twist.forward_mps;
  struck_ = now();
  if (loop_) state_at_strike_ = loop_->thrower().state();
  room_m_ = vision::rules::tee_to_hog_m - robot_.scenario().stone.radius_m - truth().stone.y_m;
  if (!first_struck_) first_struck_ = struck_;
  last_place_ = truth().body;
  case_.inject(site_);
}

void Trial::strike_when_due() {
  const bool fast = since(ThrowerState::run) && truth().twist.forward_mps >= full_speed_share * trial_speed_mps;
  if (case_.strike == Strike::braking && !first_struck_ && fast) {
    first_struck_ = now();
    last_place_ = truth().body;
    finding_.speed_mps = truth().twist.forward_mps;
    robot_.rink().gyro().set_silent(true);  // any fault that makes the robot brake
  }
  if (!struck_ && due()) {
    const auto speed = finding_.speed_mps;
    const auto place = last_place_;
    strike();
    if (case_.strike == Strike::braking) {
      finding_.speed_mps = speed;
      last_place_ = place;
    }
  }
  if (struck_ && !healed_ && case_.lasts > Duration{} && now() - *struck_ >= case_.lasts) {
    if (case_.heal) case_.heal(site_);
    healed_ = true;
  }
}

bool Trial::standing() const {
  return std::abs(truth().twist.forward_mps) < standing_mps && std::abs(truth().twist.yaw_radps) < standing_radps;
}

void Trial::watch() {
  judge_->watch(truth(), loop_->thrower());
  if (first_struck_ && !stood_) {
    const PlanarPose& place = truth().body;
    finding_.stop_distance_m += std::hypot(place.x_m - last_place_.x_m, place.y_m - last_place_.y_m);
    last_place_ = place;
  }
  if (!struck_) return;
  if (!detected_ && case_.strike == Strike::braking) {
    const auto& errors = loop_->device_errors();
    const auto later =
        std::ranges::find_if(errors, [&](const auto& e) { return e.since > *struck_ && e.device != first_fault; });
    if (later != errors.end()) detected_ = later->since;
  } else if (!detected_ && site_.loop_dead) {
    if (!site_.left().operation_enabled() || !site_.right().operation_enabled()) detected_ = now();
  } else if (!detected_ && loop_->thrower().abort_reason()) {
    detected_ = now();
  }
  const bool braked = loop_->thrower().abort_reason() || loop_->thrower().released() || site_.loop_dead;
  if (!stood_ && braked && standing()) stood_ = now();
}

void Trial::carry_out_throw() {
  for (const Stamp begin = now(); now() - begin < throw_limit;) {
    strike_when_due();
    period();
    watch();
    const bool over = loop_->thrower().finished() || site_.loop_dead;
    if (over && standing()) return;
  }
}

void Trial::note_end() {
  finding_.result = judge_->verdict(truth(), loop_->thrower(), now());
  finding_.held = truth().held;
  finding_.over_the_line = finding_.result.hog_line_violation;
  finding_.log = log();
  if (struck_ && detected_) finding_.detected_after_s = seconds(*detected_ - *struck_);
  if (first_struck_ && stood_) finding_.stopped_after_s = seconds(*stood_ - *first_struck_);
}

// The reason, and what the devices said afterwards where it does not name one.
std::string Trial::log() const {
  constexpr std::size_t at_most = 2;
  std::string text = emergency_;
  const auto add = [&text](const std::string& words) {
    if (!words.empty()) text += (text.empty() ? "" : "; then ") + words;
  };
  add(loop_->thrower().abort_reason().value_or(""));
  if (text.starts_with("device: ") || loop_->device_errors().empty()) return text;
  std::size_t told = 0;
  for (const hw::DeviceError& e : loop_->device_errors()) {
    if (text.find(e.device + ": " + to_string(e.kind)) != std::string::npos || told == at_most) continue;
    add(e.device + ": " + to_string(e.kind) + ": " + e.what);
    ++told;
  }
  return text;
}

void Trial::recover() {
  pass(500ms);
  const Posture before = Posture::of(truth());
  if (!healed_ && case_.heal) case_.heal(site_);
  if (case_.strike == Strike::braking) robot_.rink().gyro().set_silent(false);
  healed_ = true;
  pass(recovery_time);
  finding_.moved_on_recovery = before.differs(Posture::of(truth()));
  if (finding_.log.empty() || case_.strike == Strike::braking) finding_.log = log();
}

// Whoever re-arms has seen to the cause, and nothing moves before a new order.
void Trial::rearm() {
  const ThrowerDevices d = robot_.devices();
  const Posture before = Posture::of(truth());
  d.drive.rearm();
  d.gripper.rearm();
  d.arm.rearm();
  d.gyro.rearm();
  d.near_camera.rearm();
  d.low_camera.rearm();
  pass(recovery_time);
  finding_.moved_on_rearming = before.differs(Posture::of(truth()));
  const hw::DrivePhase phase = d.drive.state().phase;
  finding_.ready_again = !first_error(d) && (phase == hw::DrivePhase::ready || phase == hw::DrivePhase::stopped);
}

}  // namespace

Finding try_fault(const Case& fault) { return Trial(fault).run(); }

Struck strike_at(const Case& fault, const Moment& moment) { return Trial(fault, moment).run_on(); }

}  // namespace hogline::faults
