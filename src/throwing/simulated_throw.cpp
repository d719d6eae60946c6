#include "src/throwing/simulated_throw.hpp"

#include "src/throwing/throw_recorder.hpp"

namespace hogline {
namespace {

constexpr Duration boot_limit = std::chrono::seconds{8};
}  // namespace

config::ThrowerRig simulated_rig(const ThrowRequest& request) {
  return request.eyes == Eyes::oracle ? with_small_pictures(request.rig) : request.rig;
}

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
          practice_quality(),
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
  SimulatedRobot robot(simulated_rig(request), request.scenario, request.render_threads);
  const Duration period = request.rig.drive.timing.control_period;
  boot(robot, period);

  const Stamp start = robot.rink().now();
  VisionSeer vision(*request.rig.rig.near_camera, *request.rig.rig.low_camera);
  OracleSeer oracle = oracle_of(robot, request.rig);
  SheetSeer& seer = request.eyes == Eyes::oracle ? static_cast<SheetSeer&>(oracle) : vision;
  ThrowerLoop loop(robot.devices(), ThrowerEyes(seer, request.rig.looks),
                   servo::Thrower(request.rig.thrower, request.order, start), servo::Supervisor(request.rig.thrower));
  loop.arm(start);
  ThrowRecorder recorder(request, robot, start);
  for (;;) {
    robot.rink().step(period);
    const Stamp now = robot.rink().now();
    recorder.before(now, loop.thrower());
    loop.step(now, period);
    recorder.after(now, loop.thrower(), progress);
    if (recorder.robot_done(now, loop.thrower()) && !recorder.stone_slides(now)) break;
  }
  return recorder.outcome(loop, vision);
}

}  // namespace hogline
