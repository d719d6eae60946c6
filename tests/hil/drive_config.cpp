#include <array>

#include "src/steel/robot_bus.hpp"
#include "tests/hil/drive_config.hpp"

namespace hogline::hil {

using namespace std::chrono_literals;

hw::TwoWheelDriveConfig patient_drive_config() {
  hw::WheelConfig wheel{.name = "left wheel", .node = 1, .vendor_id = 0x539, .product_code = 0x402, .direction = 1};
  wheel.gear_ratio = 10.0;
  wheel.position_counts_per_motor_rev = 4096.0;
  wheel.velocity_units_per_motor_rps = 4096.0;
  wheel.acceleration_units_per_motor_rps2 = 4096.0;
  wheel.max_speed_radps = 50.0;
  wheel.quick_stop_radps2 = 40.0;
  hw::TwoWheelDriveConfig config;
  config.left = wheel;
  config.right = wheel;
  config.right.name = "right wheel";
  config.right.node = 2;
  config.right.direction = -1;
  config.master_node = 127;
  config.timing.command_age_limit = 2s;
  config.timing.feedback_timeout = 2s;
  config.timing.rpdo_timeout = 3s;
  config.timing.heartbeat_timeout = 2s;
  config.timing.sdo_timeout = 5s;
  config.timing.boot_timeout = 15s;
  config.timing.state_timeout = 5s;
  config.timing.quick_stop_timeout = 1s;
  config.timing.stop_margin = 5s;
  config.plausibility = {
      .standstill_radps = 0.05, .speed_error_radps = 20.0, .speed_error_time = 5s, .position_mismatch_rad = 100.0};
  return config;
}

hw::SocketCanConfig wheels_bus_config(const std::string& interface) {
  hw::SocketCanConfig config = robot_bus_config(interface, std::array<std::uint8_t, 2>{1, 2}, 127);
  config.confirm_deadline = 2s;
  return config;
}

}  // namespace hogline::hil
