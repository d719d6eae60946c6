#include "src/throwing/simulated_throw.hpp"

#include <cmath>

#include "vision/geometry/pose.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

using servo::ThrowerState;

constexpr Duration boot_limit = std::chrono::seconds{8};
constexpr Duration throw_limit = std::chrono::seconds{90};
constexpr Duration slide_limit = std::chrono::seconds{60};
constexpr double at_rest_mps = 1e-3;

bool stone_moves(const hw::sim::Truth& truth) {
  return !truth.held && std::hypot(truth.stone.vx_mps, truth.stone.vy_mps) > at_rest_mps;
}

// Follows the truth through the throw, for what only the simulator can judge.
class Judge {
 public:
  Judge(const ThrowRequest& request, Stamp start) : request_(request), start_(start) {}

  void watch(const hw::sim::Truth& truth, const servo::Thrower& thrower) {
    const ThrowerState state = thrower.state();
    if (!line_start_ && state != ThrowerState::unfold && state != ThrowerState::measure &&
        state != ThrowerState::align) {
      line_start_ = truth.body;
    }
    const double nearest_m = vision::rules::tee_to_hog_m - request_.scenario.stone.radius_m;
    if (truth.held && truth.stone.y_m > nearest_m) violation_ = true;
  }

  ThrowResult verdict(const hw::sim::Truth& truth, const servo::Thrower& thrower, Stamp now) const {
    ThrowResult r;
    r.hog_line_violation = violation_;
    r.stone_burned = truth.burned.has_value();
    r.abort = thrower.abort_reason();
    if (!r.abort && !thrower.finished()) r.abort = "the throw did not come to its end in time";
    for (const auto& entry : thrower.history()) {
      r.states.push_back({servo::to_string(entry.state), seconds(entry.since - start_)});
    }
    if (line_start_) r.yaw_after_alignment_rad = vision::wrapped(line_start_->yaw_rad - request_.order.heading_rad);
    if (truth.release) r.release = judge_release(*truth.release);
    r.stop_hog_distance_m = vision::rules::tee_to_hog_m - truth.body.y_m;
    if (!truth.held && !stone_moves(truth)) r.rest = truth.stone;
    r.sim_time_s = seconds(now - start_);
    r.ok = r.release && !r.hog_line_violation && !r.stone_burned && !r.abort && thrower.finished() &&
           std::abs(r.release->hog_distance_m - r.release->target_hog_distance_m) <=
               request_.rig.thrower.release.tolerance_m;
    return r;
  }

 private:
  ReleaseOutcome judge_release(const hw::sim::ReleaseRecord& record) const {
    const servo::ShotOrder& order = request_.order;
    ReleaseOutcome o;
    o.hog_distance_m = record.hog_distance_m;
    o.target_hog_distance_m = request_.rig.thrower.release.hog_distance_m;
    o.speed_error_mps = record.speed_mps - order.speed_mps;
    o.heading_error_rad = vision::wrapped(record.heading_rad - order.heading_rad);
    if (line_start_) {
      // Left of the line through the aligned body's place at the ordered heading: along (-cos, -sin) of it.
      const double dx = record.stone_x_m - line_start_->x_m;
      const double dy = record.stone_y_m - line_start_->y_m;
      o.lateral_error_m = -dx * std::cos(order.heading_rad) - dy * std::sin(order.heading_rad);
    }
    const double sense = order.curl == servo::Curl::counter_clockwise ? 1.0 : -1.0;
    o.spin_error_radps = sense * record.spin_radps - order.spin_radps;
    return o;
  }

  const ThrowRequest& request_;
  Stamp start_;
  std::optional<PlanarPose> line_start_;
  bool violation_ = false;
};

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

// The devices boot and answer before anybody is asked to throw.
void boot(SimulatedRobot& robot, Duration period) {
  const ThrowerDevices d = robot.devices();
  const Stamp deadline = robot.rink().now() + boot_limit;
  while (robot.rink().now() < deadline && d.drive.state().phase == hw::DrivePhase::booting) {
    robot.rink().step(period);
    const Stamp now = robot.rink().now();
    d.drive.step(now);
    d.gripper.step(now);
    d.arm.step(now);
    d.gyro.step(now);
  }
}

std::optional<Stamp> run_since(const servo::Thrower& thrower) {
  for (const auto& entry : thrower.history()) {
    if (entry.state == ThrowerState::run) return entry.since;
  }
  return std::nullopt;
}

}  // namespace

ThrowOutcome throw_stone(const ThrowRequest& request, const Progress& progress) {
  SimulatedRobot robot(request.rig, request.scenario);
  const Duration period = request.rig.drive.timing.control_period;
  boot(robot, period);

  const Stamp start = robot.rink().now();
  ThrowerLoop loop(robot.devices(),
                   ThrowerEyes(*request.rig.rig.near_camera, *request.rig.rig.low_camera, request.rig.looks),
                   servo::Thrower(request.rig.thrower, request.order, start));
  Judge judge(request, start);
  ThrowOutcome outcome;
  bool fault_waits = request.fault.has_value();
  Stamp finished_at{};
  for (;;) {
    robot.rink().step(period);
    const Stamp now = robot.rink().now();
    const auto running = run_since(loop.thrower());
    if (fault_waits && running && now >= *running + from_seconds(request.fault->run_time_s)) {
      inject(request.fault->kind, robot);
      fault_waits = false;
    }
    loop.step(now, period);
    const hw::sim::Truth& truth = robot.rink().truth();
    judge.watch(truth, loop.thrower());
    const double t_s = seconds(now - start);
    outcome.log.samples.push_back(sample_of(truth, loop.thrower(), t_s));
    if (progress) progress(t_s, loop.thrower().state());

    if (loop.thrower().finished() && finished_at == Stamp{}) finished_at = now;
    const bool robot_done = finished_at != Stamp{} || now - start > throw_limit;
    const bool slides = request.follow_stone && stone_moves(truth) && now - start < throw_limit + slide_limit;
    if (robot_done && !slides) break;
  }
  outcome.result = judge.verdict(robot.rink().truth(), loop.thrower(), robot.rink().now());
  outcome.near_sight = loop.eyes().near_sight();
  outcome.low_sight = loop.eyes().low_sight();
  return outcome;
}

}  // namespace hogline
