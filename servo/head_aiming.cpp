#include "servo/head_aiming.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr Duration remembered = std::chrono::seconds(1);
constexpr double own_motion_step_s = 0.01;

Eigen::Vector3d place(const GazeTarget& target, double ahead_s, double height_m) {
  return {target.x_m + ahead_s * target.vx_mps, target.y_m + ahead_s * target.vy_mps, height_m};
}

bool finite(const GazeTarget& t, const PlanarPose& body) {
  return std::isfinite(t.x_m + t.y_m + t.vx_mps + t.vy_mps + body.x_m + body.y_m + body.yaw_rad);
}

}  // namespace

HeadAiming::HeadAiming(const HeadAimingConfig& config) : config_(config), task_(config.head, config.gains) {}

std::optional<HeadAngles> HeadAiming::point_at(double x_m, double y_m, const PlanarPose& body) const {
  const auto q = angles_for(config_.head, in_body({x_m, y_m, config_.aim_height_m}, body));
  const auto within = [](double a, const HeadAxisLimits& limits) { return a >= limits.min_rad && a <= limits.max_rad; };
  if (!q || !within(q->pan_rad, config_.pan) || !within(q->tilt_rad, config_.tilt)) return std::nullopt;
  return q;
}

SeenPoint HeadAiming::expected(const HeadAngles& q, const GazeTarget& target, double ahead_s,
                               const PlanarPose& body) const {
  const auto point = seen(config_.head, q, in_body(place(target, ahead_s, config_.aim_height_m), body));
  return point.value_or(SeenPoint{});
}

std::optional<HeadAngles> HeadAiming::joints_at(Stamp stamp) const {
  if (joints_.empty() || stamp < joints_.front().stamp) return std::nullopt;
  const auto next = std::find_if(joints_.begin(), joints_.end(), [&](const HeadJoints& j) { return j.stamp >= stamp; });
  if (next == joints_.end()) return joints_.back().angles;
  if (next == joints_.begin()) return next->angles;
  const HeadJoints &a = *(next - 1), &b = *next;
  const double u = seconds(stamp - a.stamp) / seconds(b.stamp - a.stamp);
  return HeadAngles{a.angles.pan_rad + u * (b.angles.pan_rad - a.angles.pan_rad),
                    a.angles.tilt_rad + u * (b.angles.tilt_rad - a.angles.tilt_rad)};
}

bool HeadAiming::look(const GazeLook& look, const GazeTarget& target_then, const PlanarPose& body) {
  const auto q = joints_at(look.stamp);
  if (!q || !std::isfinite(look.x + look.y) || !finite(target_then, body)) return false;
  const SeenPoint point = expected(*q, target_then, 0.0, body);
  const Eigen::Vector2d difference(look.x - point.x, look.y - point.y);
  if (point.depth_m <= 0.0 || difference.norm() > config_.greatest_difference) return false;
  if (last_look_ && look.stamp <= *last_look_) return false;
  const double since_s = last_look_ ? seconds(look.stamp - *last_look_) : 1e9;
  difference_ += (1.0 - std::exp(-since_s / config_.difference_time_s)) * (difference - difference_);
  last_look_ = look.stamp;
  return true;
}

/// The rate that may be commanded: from the last one by no more than the acceleration, and slow enough to stop before
/// the joint's limit.
double HeadAiming::limited(double rate, double before, double angle, const HeadAxisLimits& limits, double dt_s) const {
  const double a = limits.max_acceleration_radps2;
  const auto slow_enough = [&](double room) {
    const double usable =
        std::max(0.0, room - config_.limit_margin_rad - std::abs(before) * (config_.drive_lag_s + dt_s));
    return std::sqrt(2.0 * 0.5 * a * usable);
  };
  const double up = std::min(limits.max_speed_radps, slow_enough(limits.max_rad - angle));
  const double down = std::min(limits.max_speed_radps, slow_enough(angle - limits.min_rad));
  const double wanted = std::clamp(rate, -down, up);
  return std::clamp(wanted, before - a * dt_s, before + a * dt_s);
}

HeadAimingCommand HeadAiming::refused(std::string reason) {
  pan_radps_ = tilt_radps_ = 0.0;
  HeadAimingCommand command;
  command.reason = std::move(reason);
  return command;
}

HeadAimingCommand HeadAiming::step(Stamp now, Duration dt, const HeadJoints& joints, const GazeTarget& target,
                                   const PlanarPose& body) {
  const double sum = joints.angles.pan_rad + joints.angles.tilt_rad + joints.pan_radps + joints.tilt_radps;
  if (!std::isfinite(sum) || !finite(target, body)) return refused("joints, target or body are not finite");
  if (joints_.empty() || joints.stamp > joints_.back().stamp) joints_.push_back(joints);
  while (joints_.back().stamp - joints_.front().stamp > remembered) joints_.pop_front();
  if (now - joints.stamp > config_.stale) return refused("the joints' angles are too old");

  // Where head and stone will be when a rate commanded now has taken effect.
  const double joints_ahead_s = seconds(now - joints.stamp) + config_.drive_lag_s;
  const double target_ahead_s = seconds(now - target.stamp) + config_.drive_lag_s;
  const HeadAngles q{joints.angles.pan_rad + joints_ahead_s * joints.pan_radps,
                     joints.angles.tilt_rad + joints_ahead_s * joints.tilt_radps};
  SeenPoint point = expected(q, target, target_ahead_s, body);
  const SeenPoint next = expected(q, target, target_ahead_s + own_motion_step_s, body);
  if (point.depth_m <= 0.0 || next.depth_m <= 0.0) return refused("the stone is not in front of the head");
  const double x_per_s = (next.x - point.x) / own_motion_step_s, y_per_s = (next.y - point.y) / own_motion_step_s;
  point.x += difference_.x();
  point.y += difference_.y();

  const GazeLaw law = task_.law(q, point, x_per_s, y_per_s);
  if (!law.ok) return refused(law.reason);
  HeadAimingCommand command;
  command.ok = true;
  command.off_axis_rad = std::atan(std::hypot(point.x, point.y));
  const double dt_s = seconds(dt);
  command.pan_radps = pan_radps_ = limited(law.pan_radps, pan_radps_, q.pan_rad, config_.pan, dt_s);
  command.tilt_radps = tilt_radps_ = limited(law.tilt_radps, tilt_radps_, q.tilt_rad, config_.tilt, dt_s);
  command.limited = command.pan_radps != law.pan_radps || command.tilt_radps != law.tilt_radps;
  return command;
}

}  // namespace hogline::servo
