#include "hw/sim/gyro_device.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace hogline::hw::sim {

namespace {

constexpr double earth_rate_radps = 15.04 / 3600.0 * std::numbers::pi / 180.0;
constexpr double rate_step_degps = 60e-6;
constexpr double angle_step_deg = 6e-6;

std::string text(double value, bool valid) {
  std::array<char, 64> line{};
  std::snprintf(line.data(), line.size(), "%11.6f %d\r\n", value, valid ? 1 : 0);
  return line.data();
}

// Valid, two bits of synchronisation, type, parity, content; the parity makes the number of ones odd.
std::string word(double steps, bool valid, unsigned type) {
  std::uint32_t bits = static_cast<std::uint32_t>(std::lround(steps)) & 0x03FFFFFFU;
  bits |= type << 27U | (valid ? 1U << 31U : 0U);
  if (std::popcount(bits) % 2 == 0) bits |= 1U << 26U;
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> static_cast<unsigned>(shift) & 0xFFU);
  return bytes;
}

}  // namespace

GyroDevice::GyroDevice(const GyroScenario& scenario, std::uint64_t seed, Stamp start)
    : scenario_(scenario),
      random_(seed),
      period_(from_seconds(1.0 / scenario.line_rate_hz)),
      now_(start),
      next_(start + period_) {}

void GyroDevice::step(Stamp now, double true_rate_radps) {
  const double span_s = seconds(now - now_);
  for (; next_ <= now; next_ += period_) {
    const double share = span_s > 0.0 ? seconds(next_ - now_) / span_s : 1.0;
    measure(next_, rate_radps_ + share * (true_rate_radps - rate_radps_));
  }
  now_ = now;
  rate_radps_ = true_rate_radps;
}

void GyroDevice::measure(Stamp when, double rate_radps) {
  // White noise of the rate whose integral walks: each sample is the mean over one period.
  const double sigma_radps = scenario_.angle_random_walk_rad_per_sqrt_s / std::sqrt(seconds(period_));
  const double against_space_radps = rate_radps + earth_rate_radps * std::sin(scenario_.latitude_rad);
  const double measured_radps =
      (1.0 + scenario_.scale_error) * against_space_radps + scenario_.bias_radps + sigma_radps * unit_normal_(random_);
  if (!stuck_) last_degps_ = measured_radps * 180.0 / std::numbers::pi;
  integrated_deg_ = std::fmod(integrated_deg_ + last_degps_ * seconds(period_) + 360.0, 360.0);
  if (silent_) return;
  std::string bytes = encode(last_degps_);
  if (garbled_) bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x51);
  readings_.push_back({when + from_seconds(scenario_.latency_s), bytes});
}

std::string GyroDevice::encode(double rate_degps) {
  const double increment_deg = rate_degps * seconds(period_);
  switch (mode_) {
    case Mode::rate:
      return scenario_.binary ? word(rate_degps / rate_step_degps, valid_, 0) : text(rate_degps, valid_);
    case Mode::incremental_angle:
      return scenario_.binary ? word(increment_deg / angle_step_deg, valid_, 1) : text(increment_deg, valid_);
    case Mode::integrated_angle:
      return scenario_.binary ? word(integrated_deg_ / angle_step_deg, valid_, 2) : text(integrated_deg_, valid_);
  }
  return {};
}

std::string GyroDevice::read() {
  std::string bytes;
  if (held_) return bytes;
  for (; !readings_.empty() && readings_.front().arrival <= now_; readings_.pop_front())
    bytes += readings_.front().bytes;
  return bytes;
}

void GyroDevice::write(std::string_view bytes) {
  if (deaf_) return;
  for (const char letter : bytes) {
    if (letter == 'R') mode_ = Mode::rate;
    if (letter == 'A') mode_ = Mode::incremental_angle;
    if (letter == 'P') mode_ = Mode::integrated_angle;
    if (letter == 'Z') integrated_deg_ = 0.0;
  }
}

}  // namespace hogline::hw::sim
