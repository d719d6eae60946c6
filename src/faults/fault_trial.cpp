#include "src/faults/fault_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/throwing/throw_judge.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::faults {
namespace {

using namespace std::chrono_literals;
using servo::ThrowerState;

constexpr double speed_mps = 2.5;
constexpr double full_speed_share = 0.98;
constexpr Duration throw_limit = 60s;
constexpr Duration recovery_time = 3s;
constexpr double standing_mps = 0.01;
constexpr double standing_radps = 0.02;
constexpr double moved_m = 0.002;
constexpr const char* first_fault = "gyro";  // that makes the robot brake, where there are two

ThrowRequest plain_request() {
  constexpr std::uint64_t seed = 5;
  return {
      .rig = config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig"),
      .scenario = config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice scenario", seed),
      .order = {.speed_mps = speed_mps, .heading_rad = 0.0, .curl = servo::Curl::counter_clockwise, .spin_radps = 1.5},
      .fault = std::nullopt,
      .eyes = Eyes::oracle,
      .follow_stone = false};
}

ThrowRequest prepared(const Case& fault, ThrowRequest request) {
  if (fault.prepare) fault.prepare(request);
  request.rig = with_small_pictures(std::move(request.rig));
  return request;
}

ThrowRequest request_of(const Case& fault) { return prepared(fault, plain_request()); }

ThrowRequest request_of(const Case& fault, const Moment& moment) {
  ThrowRequest request = plain_request();
  request.scenario =
      config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice scenario", moment.seed);
  request.order = moment.order;
  return prepared(fault, std::move(request));
}

std::optional<hw::DeviceError> first_error(const ThrowerDevices& d) {
  for (const auto& error : {d.drive.state().error, d.gripper.state().error, d.arm.state().error, d.gyro.state().error,
                            d.near_camera.error(), d.low_camera.error()}) {
    if (error) return error;
  }
  return std::nullopt;
}

// What can move, and must not.
struct Posture {
  PlanarPose body;
  double arm = 0.0;
  bool held = false;

  static Posture of(const hw::sim::Truth& truth) {
    return {.body = truth.body, .arm = truth.arm_unfolded, .held = truth.held};
  }
  bool differs(const Posture& other) const {
    const double way_m = std::hypot(body.x_m - other.body.x_m, body.y_m - other.body.y_m);
    return way_m > moved_m || std::abs(body.yaw_rad - other.body.yaw_rad) > moved_m ||
           std::abs(arm - other.arm) > 1e-6 || held != other.held;
  }
};

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
    judge();
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
  void judge();
  void judge_stop();
  void period();
  void pass(Duration span);
  bool due() const;
  std::optional<Stamp> since(ThrowerState state) const;
  const hw::sim::Truth& truth() const { return robot_.rink().truth(); }
  Stamp now() const { return robot_.rink().now(); }
  bool standing() const;
  void expect(bool fine, std::string what) {
    if (!fine) finding_.failures.push_back(std::move(what));
  }

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
  const bool fast = since(ThrowerState::run) && truth().twist.forward_mps >= full_speed_share * speed_mps;
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
  const bool fast = since(ThrowerState::run) && truth().twist.forward_mps >= full_speed_share * speed_mps;
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
  std::string text = emergency_.empty() ? "" : emergency_ + "; then ";
  text += loop_->thrower().abort_reason().value_or("");
  if (text.starts_with("device: ") || loop_->device_errors().empty()) return text;
  std::size_t told = 0;
  for (const hw::DeviceError& e : loop_->device_errors()) {
    if (text.find(e.device + ": " + to_string(e.kind)) != std::string::npos || told == at_most) continue;
    text += "; then " + e.device + ": " + to_string(e.kind) + ": " + e.what;
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

void Trial::judge() {
  const ThrowResult& r = finding_.result;
  expect(struck_.has_value(), "was never injected");
  if (case_.expect == Expect::goes_on) {
    expect(r.ok, "the throw did not succeed: " + finding_.log);
    if (!r.release) return;
    constexpr double deg = std::numbers::pi / 180.0;
    expect(std::abs(r.release->hog_distance_m - r.release->target_hog_distance_m) < 0.05, "released at a wrong place");
    expect(std::abs(r.release->speed_error_mps) < 0.03, "released at a wrong speed");
    expect(std::abs(r.release->heading_error_rad) < 0.15 * deg, "released at a wrong heading");
    return;
  }
  judge_stop();
  expect(!finding_.moved_on_recovery, "something moved when the fault was gone");
  expect(!finding_.moved_on_rearming, "something moved when it was re-armed");
  if (case_.heal) expect(finding_.ready_again, "is not ready after re-arming");
}

void Trial::judge_stop() {
  const double detected_s = finding_.detected_after_s.value_or(1e9);
  expect(detected_s <= seconds(case_.deadline), finding_.detected_after_s
                                                    ? fmt::format("detected after {:.0f} ms", 1e3 * detected_s)
                                                    : std::string("not detected"));
  expect(finding_.stopped_after_s.has_value(), "the robot did not stop");
  expect(finding_.log.find(case_.says) != std::string::npos, "the log does not say \"" + case_.says + "\"");
  if (case_.expect == Expect::brakes_after) {
    expect(finding_.result.release && !finding_.result.hog_line_violation && !finding_.result.stone_burned,
           "the stone was not let go in its window");
  } else {
    expect(finding_.held || case_.expect == Expect::stops_without_stone, "the stone was not kept");
    expect(!finding_.over_the_line || case_.strike == Strike::too_late, "the stone was carried into the hog line");
  }
  // Reaction, the quick stop's ramp of 2.5 m/s2, and its lag.
  const double v = finding_.speed_mps;
  const double blind_s = std::min(detected_s, 1.0) + (case_.strike == Strike::braking ? 0.25 : 0.1);
  const double limit_m = case_.stop_limit_m > 0.0 ? case_.stop_limit_m : v * blind_s + v * v / (2.0 * 2.5) + 0.15;
  finding_.braked = finding_.stopped_after_s.has_value() && finding_.stop_distance_m <= limit_m;
  expect(finding_.stop_distance_m <= limit_m,
         fmt::format("took {:.2f} m to stop, {:.2f} m allowed", finding_.stop_distance_m, limit_m));
}

}  // namespace

Finding try_fault(const Case& fault) { return Trial(fault).run(); }

Struck strike_at(const Case& fault, const Moment& moment) { return Trial(fault, moment).run_on(); }

}  // namespace hogline::faults
