#include "hw/sim/rink_cameras.hpp"

#include <algorithm>
#include <cmath>

#include "hw/sim/people.hpp"

namespace hogline::hw::sim {

namespace {

constexpr std::uint64_t near_sequence = 0x6e656172;
constexpr std::uint64_t low_sequence = 0x6c6f77;
constexpr Colour red_plate{0.60F, 0.02F, 0.02F};
constexpr Colour yellow_plate{0.75F, 0.55F, 0.02F};

Colour colour_of(const Reflectance& light) {
  return {static_cast<float>(light.red), static_cast<float>(light.green), static_cast<float>(light.blue)};
}

Divider divider_of(SidelineKind kind) {
  switch (kind) {
    case SidelineKind::line:
      return Divider::line;
    case SidelineKind::bumper:
      return Divider::bumper;
    case SidelineKind::rope:
      return Divider::rope;
    case SidelineKind::none:
      return Divider::none;
  }
  return Divider::none;
}

// A rocking body turns about its y axis where it stands on the ice.
BodyMotion motion_of(const WorldHistory::Place& place) {
  BodyMotion motion;
  const vision::Pose upright = vision::eMb(place.body);
  motion.eMb = upright;
  motion.eMb.rotate(Eigen::AngleAxisd(place.pitch_rad, Eigen::Vector3d::UnitY()));
  motion.velocity.linear = upright.linear() * Eigen::Vector3d(place.twist.forward_mps, place.twist.left_mps, 0.0);
  motion.velocity.angular = upright.linear() * Eigen::Vector3d(0.0, place.pitch_rate_radps, place.twist.yaw_radps);
  return motion;
}

CameraWorld world_of(const Rink& rink, const Scenario& scenario, bool on_the_arm) {
  CameraWorld world;
  world.body = [&rink](Stamp stamp) { return motion_of(rink.history().at(stamp)); };
  world.things = [&rink, radius_m = scenario.stone.radius_m, people = scenario.people, seed = scenario.seed](
                     Stamp stamp, Exposure& exposure) {
    const auto place = rink.history().at(stamp);
    exposure.stones.push_back(look_of(place.stone, radius_m, place.stone_team));
    for (std::size_t i = 0; i < place.others.size(); ++i) {
      exposure.stones.push_back(look_of(place.others[i], radius_m, place.other_teams[i]));
    }
    exposure.people = people_at(people, seed, stamp);
  };
  if (on_the_arm) world.uncovered = [&rink](Stamp stamp) { return rink.history().at(stamp).arm_unfolded >= 1.0; };
  return world;
}

RenderedCamera camera_of(const Rink& rink, const Scenario& scenario, const CameraRig& rig, const CameraScenario& camera,
                         bool on_the_arm, std::uint64_t sequence, int threads) {
  const std::uint64_t seed = scenario.seed ^ sequence << 32U;
  vision::Mount mount = rig.mount;
  mount.pitch_rad += camera.pitch_error_rad;
  return {SheetRenderer(rig.intrinsics, ice_of(scenario), appearance_of(scenario), sensor_of(scenario, rig, camera),
                        seed, threads),
          vision::bMc(mount), timing_of(camera, rink.start()), world_of(rink, scenario, on_the_arm), seed};
}

}  // namespace

CameraTiming timing_of(const CameraScenario& camera, Stamp start) {
  const double spread_s = 3.0 * camera.latency_jitter_s;
  return {.start = start.time_since_epoch() + from_seconds(0.5 * camera.exposure_s),
          .rate_hz = camera.rate_hz,
          .exposure_s = camera.exposure_s,
          .latency_s = camera.latency_s,
          .latency_jitter_s = camera.latency_jitter_s,
          .min_latency_s = std::max(camera.latency_s - spread_s, 0.0),
          .max_latency_s = camera.latency_s + spread_s};
}

SensorModel sensor_of(const Scenario& scenario, const CameraRig& rig, const CameraScenario& camera) {
  SensorModel sensor;
  sensor.gamma = rig.gamma;
  sensor.full_scale_electrons = camera.electrons_full_scale;
  sensor.read_noise_electrons = camera.read_noise_electrons;
  sensor.pebble_contrast = scenario.sheet.pebble_contrast;
  return sensor;
}

vision::Ice ice_of(const Scenario& scenario) {
  return {.paint_depth_m = scenario.sheet.paint_depth_m, .refractive_index = scenario.sheet.refractive_index};
}

StoneLook look_of(const StoneTruth& stone, double radius_m, int team) {
  StoneLook look;
  look.x_m = stone.x_m;
  look.y_m = stone.y_m;
  look.handle_rad = stone.handle_rad;
  look.radius_m = radius_m;
  look.plate = team == 0 ? red_plate : yellow_plate;
  return look;
}

RinkAppearance appearance_of(const Scenario& scenario) {
  const auto& sheet = scenario.sheet;
  RinkAppearance look;
  look.sheet.width_m = sheet.width_m;
  look.sheet.divider = divider_of(sheet.sideline);
  look.sheet.divider_width_m = sheet.sideline_width_m;
  look.sheet.neighbours = sheet.neighbours;
  std::ranges::transform(sheet.rings, look.sheet.rings.begin(), colour_of);
  look.sheet.ice = colour_of(sheet.ice);
  look.sheet.hog_line = colour_of(sheet.hog_line);
  look.sheet.thin_lines = colour_of(sheet.thin_lines);
  look.sheet.divider_colour = colour_of(sheet.sideline_colour);
  look.light.level = scenario.light.level;
  look.light.falloff_per_m = scenario.light.falloff_per_m;
  look.light.lamp_gloss = scenario.light.lamp_gloss;
  return look;
}

RenderedCamera near_camera(const Rink& rink, const Scenario& scenario, const CameraRig& rig, int threads) {
  return camera_of(rink, scenario, rig, scenario.near_camera, true, near_sequence, threads);
}

RenderedCamera low_camera(const Rink& rink, const Scenario& scenario, const CameraRig& rig, int threads) {
  return camera_of(rink, scenario, rig, scenario.low_camera, false, low_sequence, threads);
}

}  // namespace hogline::hw::sim
