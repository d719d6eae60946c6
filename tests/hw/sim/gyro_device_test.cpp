// The simulated gyro's lines.
#include "hw/sim/gyro_device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace hogline::hw::sim {
namespace {

using namespace std::chrono_literals;

constexpr double degree = 3.14159265358979323846 / 180.0;

struct Reading {
  double rate_degps;
  int valid;
};

std::vector<Reading> readings_of(const std::string& bytes) {
  std::istringstream text(bytes);
  std::vector<Reading> readings;
  for (Reading reading{}; text >> reading.rate_degps >> reading.valid;) readings.push_back(reading);
  return readings;
}

std::string record(GyroDevice& gyro, Duration span, double rate_radps) {
  std::string bytes;
  for (Stamp now{}; now < Stamp{} + span;) {
    gyro.step(now += 5ms, rate_radps);
    bytes += gyro.read();
  }
  return bytes;
}

TEST(GyroDevice, writes_a_hundred_lines_a_second) {
  GyroDevice gyro({.line_rate_hz = 100.0}, 1, Stamp{});
  const auto bytes = record(gyro, 2s, 10.0 * degree);
  const auto readings = readings_of(bytes);
  EXPECT_EQ(readings.size(), 200U);
  EXPECT_NEAR(readings.back().rate_degps, 10.0, 1e-6);
  EXPECT_EQ(readings.back().valid, 1);
  EXPECT_EQ(bytes.substr(bytes.size() - 15), "  10.000000 1\r\n");
}

TEST(GyroDevice, has_the_stated_bias_scale_and_noise) {
  GyroDevice gyro(
      {.line_rate_hz = 100.0, .bias_radps = 0.001, .scale_error = 0.002, .angle_random_walk_rad_per_sqrt_s = 2e-5}, 1,
      Stamp{});
  const auto readings = readings_of(record(gyro, 200s, 0.5));
  double mean = 0.0;
  double square = 0.0;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    const double error = readings[i].rate_degps * degree - (0.5 * 1.002 + 0.001);
    mean += error / static_cast<double>(readings.size());
    square += error * error / static_cast<double>(readings.size());
  }
  EXPECT_NEAR(mean, 0.0, 1e-5);
  EXPECT_NEAR(std::sqrt(square), 2e-4, 1e-5);
}

TEST(GyroDevice, lines_arrive_after_their_latency) {
  GyroDevice gyro({.line_rate_hz = 100.0, .latency_s = 0.003}, 1, Stamp{});
  gyro.step(Stamp{10ms}, 0.0);
  EXPECT_EQ(gyro.read(), "");
  gyro.step(Stamp{13ms}, 0.0);
  EXPECT_EQ(readings_of(gyro.read()).size(), 1U);
}

TEST(GyroDevice, the_same_seed_gives_the_same_bytes) {
  const auto bytes = [](std::uint64_t seed) {
    GyroDevice gyro({.line_rate_hz = 100.0, .angle_random_walk_rad_per_sqrt_s = 2e-5}, seed, Stamp{});
    return record(gyro, 1s, 0.1);
  };
  EXPECT_EQ(bytes(1), bytes(1));
  EXPECT_NE(bytes(1), bytes(2));
}

TEST(GyroDevice, says_when_it_is_faulty_and_can_fall_silent) {
  GyroDevice gyro({.line_rate_hz = 100.0}, 1, Stamp{});
  gyro.set_valid(false);
  EXPECT_EQ(readings_of(record(gyro, 100ms, 0.0)).back().valid, 0);
  GyroDevice silent({.line_rate_hz = 100.0}, 1, Stamp{});
  silent.set_silent(true);
  EXPECT_EQ(record(silent, 100ms, 0.0), "");
}

}  // namespace
}  // namespace hogline::hw::sim
