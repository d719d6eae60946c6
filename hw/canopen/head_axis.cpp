#include "hw/canopen/head_axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "hw/canopen/drive_pdos.hpp"
#include "hw/canopen/drive_setup.hpp"

namespace hogline::hw {

HeadAxis::HeadAxis(const HeadAxisConfig& axis, const TwoAxisHeadConfig& config)
    : config_(axis),
      units_(axis.gearing),
      answer_time_(config.timing.state_timeout),
      node_(axis.identity, config.timing, head_axis_setup(axis, config.timing, config.master_node),
            profile_position_mode, units_.velocity_units(config.plausibility.standstill_radps)),
      check_(config.plausibility, axis.max_speed_radps) {}

void HeadAxis::boot(Stamp now) {
  check_.restart();
  node_.boot(now);
}

void HeadAxis::on_frame(const StampedCanFrame& received, Stamp now) {
  if (const auto travel = node_.on_frame(received, now)) {
    check_.on_feedback(units_.travel_rad(travel->from, travel->to), rate_radps(), travel->dt);
  }
}

double HeadAxis::angle_rad() const { return units_.travel_rad(config_.zero_counts, node_.position()); }

// ---- what is asked of it ----

bool HeadAxis::within_limits(double angle_rad) const {
  return std::isfinite(angle_rad) && angle_rad >= config_.min_rad && angle_rad <= config_.max_rad;
}

bool HeadAxis::within_speed(double rate_radps) const {
  return std::isfinite(rate_radps) && std::abs(rate_radps) <= config_.max_speed_radps;
}

void HeadAxis::point(double angle_rad, Stamp now) {
  node_.set_mode(profile_position_mode, now);
  handshake_.request(config_.zero_counts + units_.counts(angle_rad));
  target_rad_ = angle_rad;
  arrival_due_ = now + longest_move(std::abs(angle_rad - this->angle_rad())) + answer_time_;
  on_target_ = false;
  rate_radps_ = 0.0;
}

void HeadAxis::track(double rate_radps, Stamp now) {
  node_.set_mode(cyclic_sync_velocity_mode, now);
  handshake_.restart();
  target_rad_.reset();
  on_target_ = false;
  rate_radps_ = allowed_rate(rate_radps);
}

// As fast towards a limit as still allows to brake before it: by half of the profile's deceleration, and beginning some
// control periods earlier, for the way to the drive and its lag.
double HeadAxis::allowed_rate(double rate_radps) const {
  constexpr double lag_s = 0.03;
  const double gap_rad = rate_radps > 0.0 ? config_.max_rad - angle_rad() : angle_rad() - config_.min_rad;
  const double room_rad = gap_rad - std::abs(rate_radps_) * lag_s;
  const double fastest = std::sqrt(config_.acceleration_radps2 * std::max(room_rad, 0.0));
  return std::clamp(rate_radps, -fastest, fastest);
}

// From any speed: brake, accelerate, go and brake again.
Duration HeadAxis::longest_move(double way_rad) const {
  const double ramp_s = config_.max_speed_radps / config_.acceleration_radps2;
  return from_seconds(3.0 * ramp_s + way_rad / config_.max_speed_radps);
}

// ---- each step ----

void HeadAxis::step(Stamp now) {
  const bool was_operational = node_.operational();
  node_.step(now);
  if (!node_.operational()) return;
  if (!was_operational) return check_.restart();
  if (node_.following() && node_.in_mode() && node_.wanted_mode() == cyclic_sync_velocity_mode) {
    check_.on_following(rate_radps_, rate_radps(), now);
  } else {
    check_.on_not_following();
  }
  if (check_.problem()) node_.fail(DeviceErrorKind::implausible, *check_.problem(), now);
  supervise_move(now);
}

void HeadAxis::supervise_move(Stamp now) {
  if (!target_rad_ || !node_.following() || !node_.in_mode()) return;
  const std::uint16_t statusword = node_.statusword();
  if (statusword & following_error_bit) {
    return node_.fail(DeviceErrorKind::device_fault, "following error: the axis does not keep up with its profile",
                      now);
  }
  if (handshake_.overdue(now, answer_time_)) {
    const bool raised = handshake_.phase() == SetPointHandshake::Phase::raised;
    return node_.fail(DeviceErrorKind::refused,
                      raised ? "does not acknowledge a new target (statusword bit 12)"
                             : "does not take its acknowledgement of a target back (statusword bit 12)",
                      now);
  }
  const bool reached = handshake_.settled() && (statusword & target_reached_bit) != 0;
  const double away_rad = std::abs(angle_rad() - *target_rad_);
  if (reached && away_rad > 2.0 * config_.tolerance_rad) {
    char text[96];
    std::snprintf(text, sizeof text, "claims a target that it has not reached [rad]: %.3g away", away_rad);
    return node_.fail(DeviceErrorKind::implausible, text, now);
  }
  on_target_ = reached;
  if (!reached && now > arrival_due_) {
    node_.fail(DeviceErrorKind::timeout, "does not reach its target in time", now);
  }
}

std::vector<CanFrame> HeadAxis::command(Cia402Goal goal, Stamp now) {
  const std::optional<Cia402Command> command = node_.control(goal, now);
  if (!command) return {};
  auto controlword = static_cast<std::uint16_t>(*command);
  if (!node_.following()) {
    handshake_.restart();
    target_rad_.reset();
    on_target_ = false;
    rate_radps_ = 0.0;
  } else if (node_.in_mode() && node_.wanted_mode() == profile_position_mode) {
    controlword |= handshake_.step(node_.statusword(), now);
  }
  const CanFrame target = encode(DriveTargetPdo{handshake_.target(), node_.wanted_mode()}, node_.id());
  const CanFrame control = encode(DriveCommandPdo{controlword, units_.velocity(rate_radps_)}, node_.id());
  return {target, control};
}

}  // namespace hogline::hw
