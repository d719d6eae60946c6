#include "hw/sim/skip_cameras.hpp"

#include "hw/sim/people.hpp"
#include "hw/sim/skip_people.hpp"

namespace hogline::hw::sim {
namespace {

constexpr std::uint64_t near_sequence = 0x736b6e72;
constexpr std::uint64_t far_sequence = 0x736b6672;

Eigen::Vector3d vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

vision::Pose body_pose(const SkipScenario& skip) { return vision::eMb({skip.x_m, skip.y_m, skip.yaw_rad}); }

// The tilt axis' point, with axes that turn with the head.
vision::Pose eMh(const HeadTruth& head, const SkipScenario& skip, const HeadAxes& axes) {
  const Eigen::AngleAxisd pan(head.pan_rad, Eigen::Vector3d::UnitZ());
  vision::Pose bMh = vision::Pose::Identity();
  bMh.translation() = vector(axes.pan_axis_m) + pan * vector(axes.tilt_axis_m);
  bMh.linear() = (pan * Eigen::AngleAxisd(head.tilt_rad, Eigen::Vector3d::UnitY())).toRotationMatrix();
  return body_pose(skip) * bMh;
}

vision::Pose hMc(const vision::Mount& mount, const HeadAxes& axes) {
  vision::Pose pose = vision::bMc(mount);
  pose.translation() -= vector(axes.pan_axis_m) + vector(axes.tilt_axis_m);
  return pose;
}

vision::Mount true_far_mount(const Scenario& scenario, vision::Mount mount) {
  mount.pitch_rad += scenario.skip->far_camera.pitch_error_rad;
  mount.yaw_rad += scenario.skip->far_yaw_error_rad;
  mount.roll_rad += scenario.skip->far_roll_error_rad;
  return mount;
}

vision::Mount true_near_mount(const Scenario& scenario, vision::Mount mount) {
  mount.pitch_rad += scenario.near_camera.pitch_error_rad;
  return mount;
}

BodyMotion head_motion(const SkipMoment& moment, const SkipScenario& skip, const HeadAxes& axes) {
  BodyMotion motion;
  motion.eMb = eMh(moment.head, skip, axes);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d pan_axis = body_pose(skip) * vector(axes.pan_axis_m);
  motion.velocity.linear = moment.head.pan_radps * up.cross(motion.eMb.translation() - pan_axis);
  motion.velocity.angular = moment.head.pan_radps * up + moment.head.tilt_radps * motion.eMb.linear().col(1);
  return motion;
}

CameraWorld world_of(const SkipRink& rink, const Scenario& scenario, const HeadAxes& axes) {
  CameraWorld world;
  world.body = [&rink, skip = *scenario.skip, axes](Stamp stamp) {
    return head_motion(rink.history().at(stamp), skip, axes);
  };
  world.things = [&rink, scenario, axes](Stamp stamp, Exposure& exposure) {
    const SkipMoment moment = rink.history().at(stamp);
    for (const FieldStone& s : moment.stones) {
      if (!s.taken_off) exposure.stones.push_back(look_of(s.motion, scenario.stone.radius_m, s.team));
    }
    exposure.people = skip_people(scenario, axes, moment);
  };
  return world;
}

RenderedCamera camera_of(const SkipRink& rink, const Scenario& scenario, const CameraRig& rig,
                         const vision::Mount& true_mount, const CameraScenario& camera, const HeadAxes& axes,
                         std::uint64_t sequence, int threads) {
  const std::uint64_t seed = scenario.seed ^ sequence << 32U;
  return {SheetRenderer(rig.intrinsics, ice_of(scenario), appearance_of(scenario), sensor_of(scenario, rig, camera),
                        seed, threads),
          hMc(true_mount, axes), timing_of(camera, rink.start()), world_of(rink, scenario, axes), seed};
}

}  // namespace

RenderedCamera skip_near_camera(const SkipRink& rink, const Scenario& scenario, const CameraRig& rig,
                                const HeadAxes& axes, int threads) {
  return camera_of(rink, scenario, rig, true_near_mount(scenario, rig.mount), scenario.near_camera, axes, near_sequence,
                   threads);
}

RenderedCamera skip_far_camera(const SkipRink& rink, const Scenario& scenario, const CameraRig& rig,
                               const HeadAxes& axes, int threads) {
  return camera_of(rink, scenario, rig, true_far_mount(scenario, rig.mount), scenario.skip->far_camera, axes,
                   far_sequence, threads);
}

vision::Pose true_far_pose(const SkipMoment& moment, const Scenario& scenario, const CameraRig& rig,
                           const HeadAxes& axes) {
  return eMh(moment.head, *scenario.skip, axes) * hMc(true_far_mount(scenario, rig.mount), axes);
}

vision::Pose true_near_pose(const SkipMoment& moment, const Scenario& scenario, const CameraRig& rig,
                            const HeadAxes& axes) {
  return eMh(moment.head, *scenario.skip, axes) * hMc(true_near_mount(scenario, rig.mount), axes);
}

std::vector<PersonLook> skip_people(const Scenario& scenario, const HeadAxes& axes, const SkipMoment& moment) {
  std::vector<PersonLook> people = people_at(scenario.people, scenario.seed, moment.stamp);
  if (!moment.thrown || !moment.released) return people;
  const FieldStone& thrown = moment.stones[*moment.thrown];
  if (thrown.taken_off) return people;
  const Eigen::Vector3d eye = eMh(moment.head, *scenario.skip, axes).translation();
  for (const PersonLook& p : people_about(thrown.motion, seconds(moment.stamp - *moment.released), *scenario.skip,
                                          eye.x(), eye.y(), scenario.seed)) {
    people.push_back(p);
  }
  return people;
}

}  // namespace hogline::hw::sim
