#include "src/throwing/simulated_throw.hpp"

#include "src/throwing/throw_judge.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline {
namespace {

using servo::ThrowerState;

constexpr Duration boot_limit = std::chrono::seconds{8};
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

config::ThrowerRig rig_of(const ThrowRequest& request) {
  return request.eyes == Eyes::oracle ? with_small_pictures(request.rig) : request.rig;
}

}  // namespace

config::ThrowerRig with_small_pictures(config::ThrowerRig rig) {
  constexpr int divisor = 5;
  for (auto* camera : {&*rig.rig.near_camera, &*rig.rig.low_camera}) {
    vision::Intrinsics& lens = camera->intrinsics;
    lens.width_px /= divisor;
    lens.height_px /= divisor;
    for (double* length : {&lens.fx_px, &lens.fy_px, &lens.cx_px, &lens.cy_px}) *length /= divisor;
  }
  return rig;
}

OracleSeer oracle_of(const SimulatedRobot& robot, const config::ThrowerRig& rig) {
  return {robot.rink().history(),
          robot.scenario().sheet.width_m,
          {.near = rig.rig.near_camera->mount, .low = rig.rig.low_camera->mount},
          measured_quality(),
          robot.scenario().seed};
}

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

ThrowOutcome throw_stone(const ThrowRequest& request, const Progress& progress) {
  SimulatedRobot robot(rig_of(request), request.scenario, request.render_threads);
  const Duration period = request.rig.drive.timing.control_period;
  boot(robot, period);

  const Stamp start = robot.rink().now();
  VisionSeer vision(*request.rig.rig.near_camera, *request.rig.rig.low_camera);
  OracleSeer oracle = oracle_of(robot, request.rig);
  WatchedSeer seer(request.eyes == Eyes::oracle ? static_cast<SheetSeer&>(oracle) : vision, robot.rink().history(),
                   request.watch);
  ThrowerLoop loop(robot.devices(), ThrowerEyes(seer, request.rig.looks),
                   servo::Thrower(request.rig.thrower, request.order, start), servo::Supervisor(request.rig.thrower));
  loop.arm(start);
  ThrowJudge judge(request.rig.thrower, robot.scenario(), request.order, start);
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
  for (const hw::DeviceError& error : loop.device_errors()) {
    outcome.result.device_errors.push_back(error.device + ": " + to_string(error.kind) + ": " + error.what);
  }
  outcome.near_sight = vision.near_sight();
  outcome.low_sight = vision.low_sight();
  return outcome;
}

}  // namespace hogline
