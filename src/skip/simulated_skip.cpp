#include "src/skip/simulated_skip.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "servo/skip_sheet.hpp"
#include "src/skip/skip_record.hpp"
#include "src/skip/skip_recording.hpp"
#include "src/skip/skip_vision.hpp"

namespace hogline {
namespace {

constexpr Stamp simulation_start{std::chrono::seconds{1}};  // the epoch stands for "never heard of"
constexpr Duration longest = std::chrono::seconds(150);
constexpr Duration signal_latency = std::chrono::milliseconds(30);
constexpr double signal_place_sigma_m = 0.03;
constexpr double signal_velocity_sigma_mps = 0.03;
constexpr double bit_rate_hz = 1e6;

// The drive as the rig file expects to find it.
hw::sim::HeadAxisRig axis_rig(const hw::HeadAxisConfig& axis) {
  hw::sim::HeadAxisRig rig;
  auto& d = rig.device;
  d.identity.node = axis.identity.node;
  d.identity.device_type = 0x00020192;
  d.identity.vendor_id = axis.identity.vendor_id;
  d.identity.product_code = axis.identity.product_code;
  d.identity.name = axis.identity.name;
  d.axis.encoder_counts_per_rev = axis.gearing.position_counts_per_motor_rev;
  d.axis.velocity_window_s = 0.005;
  d.position_counts_per_rev = axis.gearing.position_counts_per_motor_rev;
  d.velocity_units_per_rps = axis.gearing.velocity_units_per_motor_rps;
  d.acceleration_units_per_rps2 = axis.gearing.acceleration_units_per_motor_rps2;
  d.switch_on_time_s = 0.02;
  d.profile_position = true;
  rig.gear_ratio = axis.gearing.gear_ratio;
  rig.direction = axis.gearing.direction;
  rig.zero_counts = axis.zero_counts;
  rig.min_rad = axis.min_rad;
  rig.max_rad = axis.max_rad;
  return rig;
}

hw::sim::SkipRinkConfig rink_config(const config::SkipRig& rig, const hw::sim::Scenario& scenario) {
  return {.scenario = scenario,
          .pan = axis_rig(rig.head.pan),
          .tilt = axis_rig(rig.head.tilt),
          .bus = {.bit_rate_hz = bit_rate_hz},
          .standing = {},
          .delivery = {}};
}

hw::sim::SkipRinkConfig rink_config(const config::SkipRig& rig, const hw::sim::Scenario& scenario,
                                    const SkipScene& scene, Duration released_after) {
  hw::sim::SkipRinkConfig config = rink_config(rig, scenario);
  config.standing = scene.standing;
  config.delivery = hw::sim::Delivery{released_after, scene.thrown};
  return config;
}

hw::sim::HeadAxes axes_of(const config::SkipRig& rig) {
  return {rig.skip.aiming.head.pan_axis_m, rig.skip.aiming.head.tilt_axis_m};
}

hw::sim::CameraRig camera_rig(const vision::CameraSetup& setup) {
  return {.intrinsics = setup.intrinsics, .mount = setup.mount, .gamma = setup.gamma};
}

hw::CameraWatch watch_of(const config::Rig& rig, const std::string& camera) {
  const config::CameraSource source = rig.source(camera);
  return {.name = camera + " camera", .max_age = source.max_age, .silence_limit = source.silence_limit};
}

servo::ReleaseSignal signal_of(const hw::sim::FieldStone& stone, Stamp released, std::uint64_t seed) {
  std::mt19937_64 random(seed * 31 + 5);
  std::normal_distribution<double> normal;
  const hw::sim::StoneTruth& s = stone.motion;
  return {.stamp = released,
          .stone = {s.x_m + signal_place_sigma_m * normal(random), s.y_m + signal_place_sigma_m * normal(random),
                    s.vx_mps + signal_velocity_sigma_mps * normal(random),
                    s.vy_mps + signal_velocity_sigma_mps * normal(random), s.spin_radps},
          .place_sigma_m = signal_place_sigma_m,
          .velocity_sigma_mps = signal_velocity_sigma_mps,
          .team = stone.team == 0 ? Team::first : Team::second};
}

servo::IceEstimate learnt(const SkipRequest& request, const servo::ThrowResult& result) {
  servo::IceModel model(servo::IceModelConfig{}, request.ice);
  if (result.track) model.learn(servo::from_other_end(*result.track));
  return model.estimate();
}

}  // namespace

config::SkipRig with_small_pictures(config::SkipRig rig) {
  constexpr int divisor = 16;
  for (auto* camera : {&*rig.rig.near_camera, &*rig.rig.far_camera}) {
    vision::Intrinsics& lens = camera->intrinsics;
    lens.width_px /= divisor;
    lens.height_px /= divisor;
    for (double* length : {&lens.fx_px, &lens.fy_px, &lens.cx_px, &lens.cy_px}) *length /= divisor;
  }
  return rig;
}

SimulatedSkip::SimulatedSkip(const config::SkipRig& rig, const hw::sim::Scenario& scenario, const SkipScene& scene,
                             Duration released_after, int render_threads)
    : SimulatedSkip(rig, scenario, rink_config(rig, scenario, scene, released_after), render_threads) {}

SimulatedSkip::SimulatedSkip(const config::SkipRig& rig, const hw::sim::Scenario& scenario, int render_threads)
    : SimulatedSkip(rig, scenario, rink_config(rig, scenario), render_threads) {}

SimulatedSkip::SimulatedSkip(const config::SkipRig& rig, const hw::sim::Scenario& scenario,
                             const hw::sim::SkipRinkConfig& rink, int render_threads)
    : scenario_(scenario),
      axes_(axes_of(rig)),
      rink_(rink, simulation_start),
      head_(rink_.can(), rig.head),
      near_camera_(
          hw::sim::skip_near_camera(rink_, scenario_, camera_rig(*rig.rig.near_camera), axes_, render_threads)),
      far_camera_(hw::sim::skip_far_camera(rink_, scenario_, camera_rig(*rig.rig.far_camera), axes_, render_threads)),
      near_checked_(near_camera_, watch_of(rig.rig, "near")),
      far_checked_(far_camera_, watch_of(rig.rig, "far")) {}

servo::SkipConfig configured(const SkipRequest& request) {
  servo::SkipConfig c = request.rig.skip;
  const double spin = request.scene.thrown.motion.spin_radps;
  c.expected_spin_radps = request.announced ? spin : 0.0;
  return c;
}

SkipOutcome follow_throw(const SkipRequest& request, const SkipProgress& progress) {
  const bool oracle = request.eyes == SkipEyes::oracle;
  SimulatedSkip robot(oracle ? with_small_pictures(request.rig) : request.rig, request.scenario, request.scene,
                      request.released_after, request.render_threads);
  std::unique_ptr<SkipSeer> seer;
  if (oracle) {
    seer = std::make_unique<SkipOracle>(robot.rink(), robot.scenario(), request.rig, robot.axes(), SkipOracleQuality{});
  } else {
    seer = std::make_unique<SkipVision>(request.rig);
  }
  std::unique_ptr<RecordingSeer> recorder;
  if (!request.record.empty()) recorder = std::make_unique<RecordingSeer>(*seer, request.record);
  SkipLoop loop(robot.devices(), recorder ? static_cast<SkipSeer&>(*recorder) : *seer,
                servo::Skip(configured(request), servo::from_other_end(request.ice), robot.rink().now()));
  SkipRecord record(request, robot);
  const Duration period = request.rig.head.timing.control_period;
  bool told = false;
  while (!loop.skip().finished() && robot.rink().now() - robot.rink().start() < longest) {
    robot.rink().step(period);
    const Stamp now = robot.rink().now();
    if (request.interfere) request.interfere(robot, now);
    const auto released = robot.rink().released();
    if (request.announced && !told && released && now >= *released + signal_latency) {
      const servo::ReleaseSignal signal = signal_of(request.scene.thrown, *released, request.scenario.seed);
      loop.hear(signal);
      if (recorder) recorder->hear(signal, now);
      told = true;
    }
    loop.step(now, period);
    record.note(loop, now);
    if (progress) progress(seconds(now - robot.rink().start()), loop.skip().state());
  }
  SkipOutcome outcome = record.outcome(loop);
  outcome.ice = learnt(request, outcome.report.result);
  return outcome;
}

}  // namespace hogline
