#include "hw/sim/gyro_device.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace hogline::hw::sim {

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
  const double measured_radps =
      (1.0 + scenario_.scale_error) * rate_radps + scenario_.bias_radps + sigma_radps * unit_normal_(random_);
  if (silent_) return;
  std::array<char, 64> text{};
  const double rate_degps = measured_radps * 180.0 / std::numbers::pi;
  std::snprintf(text.data(), text.size(), "%11.6f %d\r\n", rate_degps, valid_ ? 1 : 0);
  lines_.push_back({when + from_seconds(scenario_.latency_s), text.data()});
}

std::string GyroDevice::read() {
  std::string bytes;
  for (; !lines_.empty() && lines_.front().arrival <= now_; lines_.pop_front()) bytes += lines_.front().text;
  return bytes;
}

}  // namespace hogline::hw::sim
