#include "hw/canopen/drive_config.hpp"

#include "hw/canopen/config_checks.hpp"

namespace hogline::hw {
namespace {

std::optional<std::string> wheel_error(const std::string& side, const WheelConfig& wheel) {
  if (auto error = identity_error(side + ".", identity(wheel))) return error;
  return gearing_error(side + ".", gearing(wheel), wheel.max_speed_radps, wheel.quick_stop_radps2);
}

}  // namespace

NodeIdentity identity(const WheelConfig& wheel) {
  return {.name = wheel.name, .node = wheel.node, .vendor_id = wheel.vendor_id, .product_code = wheel.product_code};
}

AxisGearing gearing(const WheelConfig& wheel) {
  return {.direction = wheel.direction,
          .gear_ratio = wheel.gear_ratio,
          .position_counts_per_motor_rev = wheel.position_counts_per_motor_rev,
          .velocity_units_per_motor_rps = wheel.velocity_units_per_motor_rps,
          .acceleration_units_per_motor_rps2 = wheel.acceleration_units_per_motor_rps2};
}

std::optional<std::string> config_error(const TwoWheelDriveConfig& config) {
  if (auto error = wheel_error("left", config.left)) return error;
  if (auto error = wheel_error("right", config.right)) return error;
  if (auto error = node_error("master_node", config.master_node)) return error;
  if (config.left.node == config.right.node || config.left.node == config.master_node ||
      config.right.node == config.master_node) {
    return "left.node, right.node and master_node must differ";
  }
  if (auto error = timing_error(config.timing)) return error;
  return plausibility_error(config.plausibility);
}

}  // namespace hogline::hw
