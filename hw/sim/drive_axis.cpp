#include "hw/sim/drive_axis.hpp"

#include <cmath>
#include <numbers>

namespace hogline::hw::sim {

void DriveAxis::turn(double dt_s, double true_speed_radps) {
  time_s_ += dt_s;
  position_rev_ += true_speed_radps * dt_s / (2.0 * std::numbers::pi);
  readings_.emplace_back(time_s_, encoder_counts());
  while (readings_.size() > 2 && readings_[1].first <= time_s_ - config_.velocity_window_s + 1e-9)
    readings_.pop_front();
}

double DriveAxis::follow(double dt_s, double demand_radps) {
  demands_.emplace_back(time_s_, demand_radps);
  while (demands_.size() > 1 && demands_[1].first <= time_s_ - config_.dead_time_s + 1e-9) demands_.pop_front();
  const bool arrived = demands_.front().first <= time_s_ - config_.dead_time_s + 1e-9;
  const double target = arrived ? demands_.front().second : speed_radps_;
  speed_radps_ += (target - speed_radps_) * (1.0 - std::exp(-config_.bandwidth_radps * dt_s));
  return speed_radps_;
}

void DriveAxis::engage(double true_speed_radps) {
  speed_radps_ = true_speed_radps;
  demands_.clear();
}

std::int64_t DriveAxis::encoder_counts() const {
  return static_cast<std::int64_t>(std::floor(position_rev_ * config_.encoder_counts_per_rev));
}

double DriveAxis::encoder_speed_rps() const {
  if (readings_.size() < 2) return 0.0;
  const auto& [first_s, first] = readings_.front();
  const auto& [last_s, last] = readings_.back();
  return static_cast<double>(last - first) / config_.encoder_counts_per_rev / (last_s - first_s);
}

}  // namespace hogline::hw::sim
