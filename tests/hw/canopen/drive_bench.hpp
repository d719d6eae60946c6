// Two simulated drives, a virtual bus and the adapter, stepped together: drives at 1 kHz, the adapter at 200 Hz.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "hw/canopen/two_wheel_drive.hpp"
#include "hw/sim/candump.hpp"
#include "tests/hw/canopen/can_bench.hpp"

namespace hogline::hw::test {

inline constexpr double gear_ratio = 20.0;

inline WheelConfig wheel_config(const char* name, std::uint8_t node, int direction) {
  return {.name = name,
          .node = node,
          .vendor_id = 0x00C0FFEE,
          .product_code = 0x402,
          .direction = direction,
          .gear_ratio = gear_ratio,
          .position_counts_per_motor_rev = 8192.0,
          .velocity_units_per_motor_rps = 600.0,  // 0.1 rpm
          .acceleration_units_per_motor_rps2 = 600.0,
          .max_speed_radps = 30.0,
          .quick_stop_radps2 = 25.0};
}

inline TwoWheelDriveConfig drive_config() {
  return {
      .left = wheel_config("left wheel", 1, 1),
      .right = wheel_config("right wheel", 2, -1),
      .master_node = 127,
      .timing = {},
      .plausibility = {
          .standstill_radps = 0.2, .speed_error_radps = 3.0, .speed_error_time = 100ms, .position_mismatch_rad = 0.3}};
}

inline sim::Cia402DriveConfig device_config(std::uint8_t node) {
  sim::Cia402DriveConfig config = drive_device(node, 0x402, "CURLING DRIVE 1");
  config.axis.encoder_counts_per_rev = 8192.0;
  config.position_counts_per_rev = 8192.0;
  config.velocity_units_per_rps = 600.0;
  config.acceleration_units_per_rps2 = 600.0;
  return config;
}

class DriveBench final : public CanBench {
 public:
  explicit DriveBench(const TwoWheelDriveConfig& config = drive_config(),
                      const sim::VirtualCanBusConfig& bus_config = {},
                      const sim::Cia402DriveConfig& left_config = device_config(1),
                      const sim::Cia402DriveConfig& right_config = device_config(2))
      : CanBench(bus_config),
        left(bus.make_endpoint(), left_config),
        right(bus.make_endpoint(), right_config),
        stray(bus.make_endpoint()),
        drive(master, config) {
    bus.set_tap([this](const StampedCanFrame& seen) {
      log += sim::candump_line(seen, "vcan0") + "\n";
      if (on_frame) on_frame(seen);
    });
  }

  void tick() override {
    advance();
    if (on_tick) on_tick();
    if (period_due()) {
      if (set_point) drive.command(*set_point, now());
      drive.step(now());
    }
    bus.deliver();
    turn(left, motor_radps[0], left_power);
    turn(right, motor_radps[1], right_power);
    if (intruder) intruder->step(now(), 0.001, 0.0);
    bus.deliver();
    travel_rad += 0.5 * (wheel_radps(0) + wheel_radps(1)) * 0.001;
    fastest_radps = std::max({fastest_radps, std::abs(wheel_radps(0)), std::abs(wheel_radps(1))});
  }

  DrivePhase phase() const override { return drive.state().phase; }

  /// Boots, enables and drives both wheels at this speed for a second. False if it did not get there.
  bool get_running(double wheel_speed_radps) {
    if (!run_until(DrivePhase::ready, 3s)) return false;
    drive.enable();
    set_point = WheelSpeeds{0.0, 0.0};
    if (!run_until(DrivePhase::enabled, 1s)) return false;
    for (double speed = 0.0; speed < wheel_speed_radps; speed += 0.02) {
      set_point = WheelSpeeds{speed, speed};
      tick();
    }
    set_point = WheelSpeeds{wheel_speed_radps, wheel_speed_radps};
    run(200ms);
    fastest_radps = 0.0;
    return drive.state().phase == DrivePhase::enabled;
  }

  /// The true speed of a wheel: positive forward.
  double wheel_radps(int wheel) const { return (wheel == 0 ? motor_radps[0] : -motor_radps[1]) / gear_ratio; }
  bool standing() const { return std::abs(wheel_radps(0)) < 0.2 && std::abs(wheel_radps(1)) < 0.2; }

  sim::Cia402DriveDevice left;
  sim::Cia402DriveDevice right;
  CanBus& stray;  ///< somebody else on the bus
  TwoWheelDrive drive;

  std::optional<WheelSpeeds> set_point;  ///< what the caller commands every period
  std::array<double, 2> motor_radps{};
  sim::AxisPower left_power = sim::AxisPower::unpowered;
  sim::AxisPower right_power = sim::AxisPower::unpowered;
  double travel_rad = 0.0;     ///< of the robot's middle, at the wheel
  double fastest_radps = 0.0;  ///< of either wheel since it was last zeroed
  std::string log;             ///< candump -L
  std::function<void(const StampedCanFrame&)> on_frame;
  std::function<void()> on_tick;  ///< what an injected fault does each millisecond
  std::unique_ptr<sim::Cia402DriveDevice> intruder;
  std::optional<CanFrame> echo;  ///< for injections that repeat frames
  bool echoing = false;

 private:
  /// An axis that follows its drive, coasts without power (0.5 s), and stops when braked (20 ms).
  void turn(sim::Cia402DriveDevice& device, double& speed_radps, sim::AxisPower& power) {
    const sim::AxisCommand command = device.step(now(), 0.001, speed_radps);
    power = command.power;
    switch (command.power) {
      case sim::AxisPower::driven:
        speed_radps = command.speed_radps;
        return;
      case sim::AxisPower::unpowered:
        speed_radps *= 1.0 - 0.001 / 0.5;
        return;
      case sim::AxisPower::braked:
        speed_radps *= 1.0 - 0.001 / 0.02;
        return;
    }
  }
};

}  // namespace hogline::hw::test
