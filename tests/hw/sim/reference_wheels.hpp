// The simulated wheel drives for tests.
#pragma once

#include "hw/sim/rink.hpp"

namespace hogline::hw::sim {

constexpr double wheel_gear = 20.0;
constexpr double wheel_counts = 65536.0;
constexpr double wheel_units = 600.0;

inline WheelRig wheel_rig(std::uint8_t node, int direction) {
  WheelRig rig;
  rig.device.identity.node = node;
  rig.device.identity.device_type = 0x00020192;
  rig.device.identity.vendor_id = 0x2F1;
  rig.device.identity.product_code = 0x402;
  rig.device.identity.name = "simulated drive";
  rig.device.axis.encoder_counts_per_rev = wheel_counts;
  rig.device.axis.velocity_window_s = 0.005;
  rig.device.position_counts_per_rev = wheel_counts;
  rig.device.velocity_units_per_rps = wheel_units;
  rig.device.acceleration_units_per_rps2 = wheel_units;
  rig.device.switch_on_time_s = 0.02;
  rig.gear_ratio = wheel_gear;
  rig.direction = direction;
  return rig;
}

}  // namespace hogline::hw::sim
