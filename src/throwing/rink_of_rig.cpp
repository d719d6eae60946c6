#include "src/throwing/rink_of_rig.hpp"

#include <utility>

namespace hogline {
namespace {

// The drive as the rig file expects to find it.
hw::sim::WheelRig wheel_rig(const hw::WheelConfig& wheel) {
  hw::sim::WheelRig rig;
  auto& d = rig.device;
  d.identity.node = wheel.node;
  d.identity.device_type = 0x00020192;
  d.identity.vendor_id = wheel.vendor_id;
  d.identity.product_code = wheel.product_code;
  d.identity.name = wheel.name;
  d.axis.encoder_counts_per_rev = wheel.position_counts_per_motor_rev;
  d.axis.velocity_window_s = 0.005;
  d.position_counts_per_rev = wheel.position_counts_per_motor_rev;
  d.velocity_units_per_rps = wheel.velocity_units_per_motor_rps;
  d.acceleration_units_per_rps2 = wheel.acceleration_units_per_motor_rps2;
  d.switch_on_time_s = 0.02;
  rig.gear_ratio = wheel.gear_ratio;
  rig.direction = wheel.direction;
  return rig;
}

}  // namespace

hw::sim::Scenario completed(hw::sim::Scenario scenario, const config::ThrowerRig& rig) {
  scenario.robot.wheel_radius_m = rig.thrower.base.wheel_radius_m;
  scenario.robot.track_m = rig.thrower.base.track_m;
  scenario.stone.stone_x_m = rig.thrower.release.stone_x_m;
  scenario.gyro.binary = rig.gyro.variant == hw::Dsp3000Variant::binary;
  if (scenario.gyro.binary) scenario.gyro.line_rate_hz *= 10.0;
  return scenario;
}

hw::sim::RinkConfig rink_config(const config::ThrowerRig& rig, const hw::sim::Scenario& scenario) {
  constexpr double bit_rate_hz = 1e6;
  return {.scenario = scenario,
          .left = wheel_rig(rig.drive.left),
          .right = wheel_rig(rig.drive.right),
          .bus = {.bit_rate_hz = bit_rate_hz}};
}

hw::sim::CameraRig camera_rig(const vision::CameraSetup& setup) {
  return {.intrinsics = setup.intrinsics, .mount = setup.mount, .gamma = setup.gamma};
}

}  // namespace hogline
