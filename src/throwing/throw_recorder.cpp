#include "src/throwing/throw_recorder.hpp"

#include <utility>

#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

using servo::ThrowerState;

constexpr Duration throw_limit = std::chrono::seconds{90};
constexpr Duration slide_limit = std::chrono::seconds{60};

ThrowSample sample_of(const hw::sim::Truth& truth, const servo::Thrower& thrower, double t_s) {
  const servo::ThrowerDiagnosis& d = thrower.diagnosis();
  return {.t_s = t_s,
          .state = thrower.state(),
          .true_body = truth.body,
          .true_speed_mps = truth.twist.forward_mps,
          .true_hog_distance_m = vision::rules::tee_to_hog_m - truth.body.y_m,
          .stone_x_m = truth.stone.x_m,
          .stone_y_m = truth.stone.y_m,
          .stone_held = truth.held,
          .believed_yaw_rad = d.yaw_rad,
          .believed_hog_distance_m = d.hog_distance_m,
          .believed_speed_mps = d.speed_mps,
          .speed_setpoint_mps = d.speed_setpoint_mps};
}

std::optional<Stamp> run_since(const servo::Thrower& thrower) {
  for (const auto& entry : thrower.history()) {
    if (entry.state == ThrowerState::run) return entry.since;
  }
  return std::nullopt;
}

}  // namespace

ThrowRecorder::ThrowRecorder(const ThrowRequest& request, SimulatedRobot& robot, Stamp start)
    : request_(request),
      robot_(robot),
      start_(start),
      judge_(request.rig.thrower, robot.scenario(), request.order, start),
      fault_waits_(request.fault.has_value()) {}

void ThrowRecorder::before(Stamp now, const servo::Thrower& thrower) {
  const auto running = run_since(thrower);
  if (!fault_waits_ || !running || now < *running + from_seconds(request_.fault->run_time_s)) return;
  inject(request_.fault->kind, robot_);
  fault_waits_ = false;
}

void ThrowRecorder::after(Stamp now, const servo::Thrower& thrower, const Progress& progress) {
  const hw::sim::Truth& truth = robot_.rink().truth();
  judge_.watch(truth, thrower);
  const double t_s = seconds(now - start_);
  log_.samples.push_back(sample_of(truth, thrower, t_s));
  if (progress) progress(t_s, thrower.state());
}

bool ThrowRecorder::robot_done(Stamp now, const servo::Thrower& thrower) const {
  return thrower.finished() || now - start_ > throw_limit;
}

bool ThrowRecorder::stone_slides(Stamp now) const {
  return request_.follow_stone && stone_moves(robot_.rink().truth()) && now - start_ < throw_limit + slide_limit;
}

ThrowOutcome ThrowRecorder::outcome(const ThrowerLoop& loop, const VisionSeer& vision) {
  ThrowOutcome outcome;
  outcome.result = judge_.verdict(robot_.rink().truth(), loop.thrower(), robot_.rink().now());
  outcome.result.measured_delay_s = loop.thrower().diagnosis().measured_delay_s;
  outcome.result.rehearsed_delays_s = loop.thrower().diagnosis().rehearsed_delays_s;
  outcome.result.believed_delay_s = loop.thrower().diagnosis().believed_delay_s;
  outcome.result.freed_at_speed_mps = loop.thrower().diagnosis().freed_at_speed_mps;
  outcome.result.fault_struck = request_.fault ? std::optional<bool>(!fault_waits_) : std::nullopt;
  for (const hw::DeviceError& error : loop.device_errors()) {
    outcome.result.device_errors.push_back(error.device + ": " + to_string(error.kind) + ": " + error.what);
  }
  outcome.log = std::move(log_);
  outcome.near_sight = vision.near_sight();
  outcome.low_sight = vision.low_sight();
  return outcome;
}

}  // namespace hogline
