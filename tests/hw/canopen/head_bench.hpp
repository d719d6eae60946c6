// Two simulated head drives, a virtual bus and the adapter, stepped together: drives at 1 kHz, the adapter at 200 Hz.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "hw/canopen/two_axis_head.hpp"
#include "tests/hw/canopen/can_bench.hpp"

namespace hogline::hw::test {

inline constexpr double head_gear_ratio = 100.0;
inline constexpr double degree = std::numbers::pi / 180.0;

inline HeadAxisConfig head_axis_config(const char* name, std::uint8_t node, int direction, std::int32_t zero_counts,
                                       double min_rad, double max_rad) {
  return {.identity = {.name = name, .node = node, .vendor_id = 0x00C0FFEE, .product_code = 0x403},
          .gearing = {.direction = direction,
                      .gear_ratio = head_gear_ratio,
                      .position_counts_per_motor_rev = 4096.0,
                      .velocity_units_per_motor_rps = 4096.0,
                      .acceleration_units_per_motor_rps2 = 4096.0},
          .zero_counts = zero_counts,
          .min_rad = min_rad,
          .max_rad = max_rad,
          .max_speed_radps = 2.0,
          .acceleration_radps2 = 6.0,
          .quick_stop_radps2 = 12.0,
          .tolerance_rad = 0.02 * degree};
}

inline TwoAxisHeadConfig head_config() {
  return {.pan = head_axis_config("pan", 3, 1, 1000, -170.0 * degree, 170.0 * degree),
          .tilt = head_axis_config("tilt", 4, -1, -20000, -20.0 * degree, 75.0 * degree),
          .master_node = 127,
          .timing = {},
          .plausibility = {.standstill_radps = 0.02,
                           .speed_error_radps = 0.5,
                           .speed_error_time = 200ms,
                           .position_mismatch_rad = 0.05}};
}

inline sim::Cia402DriveConfig head_device_config(std::uint8_t node) {
  sim::Cia402DriveConfig config = drive_device(node, 0x403, "CURLING HEAD");
  config.axis.bandwidth_radps = 150.0;
  config.axis.encoder_counts_per_rev = 4096.0;
  config.position_counts_per_rev = 4096.0;
  config.velocity_units_per_rps = 4096.0;
  config.acceleration_units_per_rps2 = 4096.0;
  config.profile_position = true;
  return config;
}

class HeadBench final : public CanBench {
 public:
  explicit HeadBench(const TwoAxisHeadConfig& head_configuration = head_config(),
                     const sim::VirtualCanBusConfig& bus_config = {})
      : CanBench(bus_config),
        config(head_configuration),
        pan(bus.make_endpoint(), head_device_config(3)),
        tilt(bus.make_endpoint(), head_device_config(4)),
        stray(bus.make_endpoint()),
        head(master, config) {
    pan.axis().slip_encoder(config.pan.zero_counts / 4096.0);  // both axes begin at angle 0
    tilt.axis().slip_encoder(config.tilt.zero_counts / 4096.0);
    bus.set_tap([this](const StampedCanFrame& seen) {
      if (on_frame) on_frame(seen);
    });
  }

  void tick() override {
    advance();
    if (period_due()) {
      if (rates) head.track(*rates, now());
      head.step(now());
    }
    bus.deliver();
    turn(pan, motor_radps[0]);
    turn(tilt, motor_radps[1]);
    bus.deliver();
  }

  DrivePhase phase() const override { return head.state().phase; }

  bool get_enabled() {
    if (!run_until(DrivePhase::ready, 3s)) return false;
    head.enable();
    return run_until(DrivePhase::enabled, 1s).has_value();
  }

  std::optional<Duration> point(double pan_rad, double tilt_rad, Duration limit = 5s) {
    head.point({pan_rad, tilt_rad}, now());
    return run_until([this] { return head.state().on_target; }, limit);
  }

  /// Where the head truly is.
  double pan_rad() { return true_angle(pan, config.pan); }
  double tilt_rad() { return true_angle(tilt, config.tilt); }
  /// The faster of its two axes.
  double speed_radps() const { return std::max(std::abs(motor_radps[0]), std::abs(motor_radps[1])) / head_gear_ratio; }
  bool standing() const { return speed_radps() < 0.005; }

  TwoAxisHeadConfig config;
  sim::Cia402DriveDevice pan;
  sim::Cia402DriveDevice tilt;
  CanBus& stray;
  TwoAxisHead head;

  std::optional<PanTiltRate> rates;  ///< what the caller asks for every period
  std::array<double, 2> motor_radps{};
  std::function<void(const StampedCanFrame&)> on_frame;

 private:
  static double true_angle(sim::Cia402DriveDevice& device, const HeadAxisConfig& axis) {
    const double zero_rev = axis.zero_counts / 4096.0;
    return axis.gearing.direction * (device.axis().position_rev() - zero_rev) * 2.0 * std::numbers::pi /
           head_gear_ratio;
  }

  /// An axis that follows its drive, and stands without it: the gear locks itself.
  void turn(sim::Cia402DriveDevice& device, double& speed_radps) {
    const sim::AxisCommand command = device.step(now(), 0.001, speed_radps);
    speed_radps = command.power == sim::AxisPower::driven ? command.speed_radps : 0.0;
  }
};

}  // namespace hogline::hw::test
