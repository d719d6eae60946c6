// Simulated jaws, belt and arm behind a real line, with gripper and arm adapters stepped beside them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "hw/sim/modbus_devices.hpp"
#include "tests/hw/modbus/adapter_config.hpp"

namespace hogline::hw {

using namespace std::chrono_literals;

inline sim::GripperScenario gripper_scenario(bool holds) {
  return {.opening_delay_s = 0.075,
          .opening_jitter_s = 0.002,
          .motion_delay_s = 0.02,
          .holds_stone_at_start = holds,
          .activation_time_s = 0.5,
          .full_stroke_time_s = 0.6};
}

enum class Wire { tcp, rtu };

struct RigConfig {
  bool holds = true;
  Duration reconnect_delay = 200ms;
  Wire wire = Wire::tcp;
  Duration response_timeout = 200ms;
};

class Rig {
  // As /dev/serial/by-id: the name stays when the terminal behind it is another one.
  std::filesystem::path link_ = std::filesystem::path(testing::TempDir()) / ("modbus_rtu_" + std::to_string(getpid()));

 public:
  explicit Rig(const RigConfig& config = {})
      : devices(gripper_scenario(config.holds), {.acceleration_radps2 = 4.0, .max_speed_radps = 3.0, .watchdog_s = 0.2},
                {.travel_time_s = 1.5, .unfolded_at_start = false, .watchdog_s = 0.2}, 7, Stamp{}),
        session({.line = {.line = line(config.wire), .response_timeout = config.response_timeout},
                 .reconnect_delay = config.reconnect_delay}),
        gripper(session, gripper_config()),
        arm(session, arm_config()) {}

  /// Control periods of 5 ms: the devices first, then the adapters.
  void run(Duration span) {
    for (const Stamp end = now + span; now < end;) {
      now += 5ms;
      devices.step(now);
      gripper.step(now);
      arm.step(now);
    }
  }
  /// The server is back: on the same port, or on another terminal behind the same link.
  void revive() {
    devices.restart();
    if (!devices.rtu_path().empty()) point_link();
  }
  bool stone_held() const { return devices.effects().stone_in_jaws; }

  sim::ModbusDevices devices;
  ModbusSession session;
  ModbusGripper gripper;
  ModbusArm arm;
  Stamp now{};

  ~Rig() {
    std::error_code gone;
    std::filesystem::remove(link_, gone);
  }

 private:
  void point_link() {
    std::filesystem::remove(link_);
    std::filesystem::create_symlink(devices.rtu_path(), link_);
  }
  std::variant<ModbusTcp, ModbusRtu> line(Wire wire) {
    if (wire == Wire::tcp) return ModbusTcp{"127.0.0.1", devices.port()};
    devices.serve_rtu();
    point_link();
    return ModbusRtu{.device = link_, .baud = 115200, .parity = 'N', .data_bits = 8, .stop_bits = 1};
  }
};

inline DeviceErrorKind kind_of(const std::optional<DeviceError>& error) {
  EXPECT_TRUE(error.has_value());
  return error ? error->kind : DeviceErrorKind::implausible;
}

}  // namespace hogline::hw
