// A simulated gyro, a line to it that can be lost, and the adapter, stepped by one clock.
#pragma once

#include <gtest/gtest.h>

#include "hw/dsp3000/dsp3000_gyro.hpp"
#include "hw/sim/gyro_device.hpp"

namespace hogline::hw {

using namespace std::chrono_literals;

inline constexpr double degree = 3.14159265358979323846 / 180.0;

inline Dsp3000Config gyro_config(Dsp3000Variant variant = Dsp3000Variant::text) {
  return {.variant = variant,
          .sign = 1.0,
          .latency = 3ms,
          .silence_limit = 30ms,
          .mode_deadline = 500ms,
          .reopen_delay = 200ms,
          .max_rate_radps = 90.0 * degree,
          .max_slew_radps2 = 2000.0 * degree,
          .stuck_limit = 100ms,
          .rest_window = 500ms,
          .max_bias_radps = 0.1 * degree,
          .max_bias_step_radps = 0.04 * degree};
}

// The noise of a good unit: 0.067 deg/sqrt(h).
inline sim::GyroScenario gyro_scenario(Dsp3000Variant variant = Dsp3000Variant::text) {
  const bool binary = variant == Dsp3000Variant::binary;
  return {.line_rate_hz = binary ? 1000.0 : 100.0,
          .bias_radps = 6.0 / 3600.0 * degree,
          .angle_random_walk_rad_per_sqrt_s = 0.067 / 60.0 * degree,
          .latency_s = 0.003,
          .binary = binary};
}

/// Straight to the device, but for what a test takes away.
class DeviceLine final : public ByteLine {
 public:
  explicit DeviceLine(sim::GyroDevice& device) : device_(device) {}
  std::optional<std::string> open() override {
    if (absent) return "no such device";
    device_.read();
    open_ = true;
    ++openings;
    return std::nullopt;
  }
  void close() override { open_ = false; }
  std::optional<std::string> read() override {
    if (absent || !open_) return std::nullopt;
    return device_.read();
  }
  bool write(std::string_view bytes) override {
    if (absent || !open_) return false;
    asked += bytes;
    device_.write(bytes);
    return true;
  }

  bool absent = false;  ///< unplugged
  int openings = 0;
  std::string asked;

 private:
  sim::GyroDevice& device_;
  bool open_ = false;
};

struct GyroBench {
  explicit GyroBench(const Dsp3000Config& config, const sim::GyroScenario& scenario)
      : device(scenario, 5, Stamp{}), line(device), gyro(line, config) {}
  explicit GyroBench(Dsp3000Variant variant = Dsp3000Variant::text)
      : GyroBench(gyro_config(variant), gyro_scenario(variant)) {}

  /// Control periods of 5 ms.
  void run(Duration span, double rate_radps = 0.0) {
    for (const Stamp end = now + span; now < end;) step(rate_radps);
  }
  void step(double rate_radps = 0.0) {
    now += 5ms;
    device.step(now, rate_radps);
    gyro.at_rest(resting);
    gyro.step(now);
  }
  /// The error's words; "" for none.
  std::string error() const { return gyro.state().error ? gyro.state().error->what : std::string(); }

  sim::GyroDevice device;
  DeviceLine line;
  Dsp3000Gyro gyro;
  Stamp now{};
  bool resting = true;
};

}  // namespace hogline::hw
