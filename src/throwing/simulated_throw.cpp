#include "src/throwing/simulated_throw.hpp"

#include "src/throwing/line_seer.hpp"
#include "src/throwing/throw_recorder.hpp"

namespace hogline {
namespace {

constexpr Duration boot_limit = std::chrono::seconds{8};
}  // namespace

config::ThrowerRig simulated_rig(const ThrowRequest& request) {
  return request.eyes == Eyes::oracle ? with_small_pictures(request.rig) : request.rig;
}

config::ThrowerRig with_small_pictures(config::ThrowerRig rig) {
  constexpr int divisor = 16;
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

void pass_period(hw::sim::Rink& rink, ThrowerLoop& loop, Duration period) {
  const Stamp end = rink.now() + period;
  if (const auto due = loop.release_due(); due && *due < end) {
    if (*due > rink.now()) rink.step(*due - rink.now());
    loop.let_go(rink.now());
  }
  if (rink.now() < end) rink.step(end - rink.now());
}

ThrowOutcome throw_stone(const ThrowRequest& request, const Progress& progress) {
  SimulatedRobot robot(simulated_rig(request), request.scenario, request.render_threads);
  const Duration period = request.rig.drive.timing.control_period;
  boot(robot, period);

  const Stamp start = robot.rink().now();
  VisionSeer vision(*request.rig.rig.near_camera, *request.rig.rig.low_camera);
  OracleSeer oracle = oracle_of(robot, request.rig);
  LineSeer lines(vision, *request.rig.rig.low_camera);
  SheetSeer& looking = request.low_by_lines ? static_cast<SheetSeer&>(lines) : vision;
  WatchedSeer seer(request.eyes == Eyes::oracle ? oracle : looking, robot.rink().history(), request.watch);
  ThrowerLoop loop(robot.devices(), ThrowerEyes(seer, request.rig.looks),
                   servo::Thrower(request.rig.thrower, request.order, start), servo::Supervisor(request.rig.thrower));
  loop.arm(start);
  ThrowRecorder recorder(request, robot, start);
  for (;;) {
    pass_period(robot.rink(), loop, period);
    const Stamp now = robot.rink().now();
    recorder.before(now, loop.thrower());
    loop.step(now, period);
    recorder.after(now, loop.thrower(), progress);
    const bool done = recorder.robot_done(now, loop.thrower());
    if (done && request.settle) robot.rink().settle();
    if (done && !recorder.stone_slides(now)) break;
  }
  return recorder.outcome(loop, vision);
}

}  // namespace hogline
