#include "hw/canopen/two_wheel_drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace hogline::hw {
namespace {

const TwoWheelDriveConfig& checked(const TwoWheelDriveConfig& config) {
  if (const auto error = config_error(config)) throw std::invalid_argument("drive: " + *error);
  return config;
}

AxisPairConfig pair_config(const TwoWheelDriveConfig& config) {
  const double ramp_s = std::max(config.left.max_speed_radps / config.left.quick_stop_radps2,
                                 config.right.max_speed_radps / config.right.quick_stop_radps2);
  return {.name = "drive",
          .master_node = config.master_node,
          .timing = config.timing,
          .duties = config.duties,
          .stop_deadline = from_seconds(ramp_s) + config.timing.stop_margin};
}

bool within(double speed_radps, double max_radps) {
  return std::isfinite(speed_radps) && std::abs(speed_radps) <= max_radps;
}

}  // namespace

TwoWheelDrive::TwoWheelDrive(CanBus& bus, const TwoWheelDriveConfig& config)
    : config_(checked(config)),
      wheels_{WheelDrive{config_.left, config_}, WheelDrive{config_.right, config_}},
      pair_(bus, pair_config(config_), {&wheels_[0], &wheels_[1]}) {}

void TwoWheelDrive::step(Stamp now) {
  pair_.listen(now);
  expire_command(now);
  pair_.advance(now);
  send(now);
}

void TwoWheelDrive::command(const WheelSpeeds& speeds, Stamp now) {
  if (!within(speeds.left_radps, config_.left.max_speed_radps) ||
      !within(speeds.right_radps, config_.right.max_speed_radps)) {
    char text[96];
    std::snprintf(text, sizeof text, "set-point %.3g, %.3g rad/s is not finite or beyond the limit", speeds.left_radps,
                  speeds.right_radps);
    return pair_.fail(DeviceErrorKind::implausible, "drive", text, now);
  }
  if (pair_.takes_commands()) pending_ = SetPoint{speeds, now};
}

void TwoWheelDrive::quick_stop() {
  pending_.reset();
  pair_.quick_stop();
}

// A set-point counts from when it was given; the first is due command_age_limit after the drive became enabled.
void TwoWheelDrive::expire_command(Stamp now) {
  if (!pair_.takes_commands()) return pending_.reset();
  if (pending_ && now - pending_->stamp > config_.timing.command_age_limit) pending_.reset();
  if (pending_) last_set_point_ = std::max(last_set_point_, pending_->stamp);
  const Duration age = now - std::max(last_set_point_, pair_.enabled_since());
  if (age <= config_.timing.command_age_limit) return;
  char text[96];
  std::snprintf(text, sizeof text, "no new set-point for %.1f ms", seconds(age) * 1e3);
  pair_.fail(DeviceErrorKind::timeout, "drive", text, now);
}

void TwoWheelDrive::send(Stamp now) {
  const std::optional<SetPoint> set_point = std::exchange(pending_, std::nullopt);
  const bool following = pair_.phase() == DrivePhase::enabled;
  const WheelSpeeds speeds = following && set_point ? set_point->speeds : WheelSpeeds{};
  const std::array targets{speeds.left_radps, speeds.right_radps};

  std::array<CanFrame, 2> commands;
  std::size_t count = 0;
  for (std::size_t i = 0; i < wheels_.size() && (set_point || !following); ++i) {
    if (const auto frame = wheels_[i].command(pair_.goal(), targets[i], now)) commands[count++] = *frame;
  }
  pair_.send(std::span{commands}.first(count), now);
}

DriveState TwoWheelDrive::state() const {
  return {.phase = pair_.phase(),
          .stamp = pair_.feedback_stamp(),
          .measured = {wheels_[0].speed_radps(), wheels_[1].speed_radps()},
          .error = pair_.error()};
}

}  // namespace hogline::hw
