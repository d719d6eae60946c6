#include "servo/refusal.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "servo/release.hpp"
#include "servo/speed_profile.hpp"

namespace hogline::servo {
namespace {

struct Named {
  const char* name;
  double value;
};

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

std::optional<std::string> not_positive(const ThrowerConfig& c) {
  const std::array values{
      Named{"base.wheel_radius_m", c.base.wheel_radius_m},
      Named{"base.track_m", c.base.track_m},
      Named{"limits.max_speed_mps", c.limits.max_speed_mps},
      Named{"limits.max_acceleration_mps2", c.limits.max_acceleration_mps2},
      Named{"limits.max_jerk_mps3", c.limits.max_jerk_mps3},
      Named{"limits.max_deceleration_mps2", c.limits.max_deceleration_mps2},
      Named{"limits.max_yaw_rate_radps", c.limits.max_yaw_rate_radps},
      Named{"limits.max_yaw_acceleration_radps2", c.limits.max_yaw_acceleration_radps2},
      Named{"release.tolerance_m", c.release.tolerance_m},
      Named{"ages.wheels", seconds(c.ages.wheels)},
      Named{"ages.gyro", seconds(c.ages.gyro)},
      Named{"ages.gripper", seconds(c.ages.gripper)},
      Named{"ages.arm", seconds(c.ages.arm)},
      Named{"ages.near_view", seconds(c.ages.near_view)},
      Named{"ages.low_view", seconds(c.ages.low_view)},
      Named{"ages.low_sight", seconds(c.ages.low_sight)},
      Named{"run.sight_from_hog_m", c.run.sight_from_hog_m},
      Named{"run.sight_to_hog_m", c.run.sight_to_hog_m},
      Named{"measure.frames", static_cast<double>(c.measure.frames)},
      Named{"alignment.gain_at_zero_per_s", c.alignment.gain_at_zero_per_s},
      Named{"alignment.gain_at_infinity_per_s", c.alignment.gain_at_infinity_per_s},
      Named{"alignment.gain_slope_per_s_rad", c.alignment.gain_slope_per_s_rad},
      Named{"alignment.tolerance_rad", c.alignment.tolerance_rad},
      Named{"alignment.rate_tolerance_radps", c.alignment.rate_tolerance_radps},
      Named{"alignment.settle_time", seconds(c.alignment.settle_time)},
      Named{"alignment.breakaway_yaw_rate_radps", c.alignment.breakaway_yaw_rate_radps},
      Named{"gyro.noise_rad_per_sqrt_s", c.gyro.noise_rad_per_sqrt_s},
      Named{"gyro.bias_sigma_radps", c.gyro.bias_sigma_radps},
      Named{"odometry.scale_sigma", c.odometry.scale_sigma},
      Named{"odometry.noise_m_per_sqrt_m", c.odometry.noise_m_per_sqrt_m},
      Named{"run.hold_distance_m", c.run.hold_distance_m},
      Named{"run.heading_gain_per_s", c.run.heading_gain_per_s},
      Named{"run.lateral_length_m", c.run.lateral_length_m},
      Named{"run.speed_tolerance_mps", c.run.speed_tolerance_mps},
      Named{"run.heading_tolerance_rad", c.run.heading_tolerance_rad},
      Named{"run.lateral_tolerance_m", c.run.lateral_tolerance_m},
      Named{"run.spin_tolerance_radps", c.run.spin_tolerance_radps},
      Named{"safety.max_yaw_rate_disagreement_radps", c.safety.max_yaw_rate_disagreement_radps},
      Named{"safety.disagreement_time", seconds(c.safety.disagreement_time)},
      Named{"deadlines.unfold", seconds(c.deadlines.unfold)},
      Named{"deadlines.rehearse", seconds(c.deadlines.rehearse)},
      Named{"deadlines.measure", seconds(c.deadlines.measure)},
      Named{"deadlines.align", seconds(c.deadlines.align)},
      Named{"deadlines.fold", seconds(c.deadlines.fold)},
      Named{"deadlines.run", seconds(c.deadlines.run)},
      Named{"deadlines.release", seconds(c.deadlines.release)},
      Named{"deadlines.brake", seconds(c.deadlines.brake)},
  };
  for (const Named& value : values) {
    if (!positive(value.value)) return std::string(value.name) + " must be positive";
  }
  return std::nullopt;
}

std::optional<std::string> negative(const ThrowerConfig& c) {
  const std::array values{
      Named{"release.hog_distance_m", c.release.hog_distance_m},
      Named{"release.stone_x_m", c.release.stone_x_m},
      Named{"release.gripper_delay_s", c.release.gripper_delay_s},
      Named{"release.gripper_delay_sigma_s", c.release.gripper_delay_sigma_s},
      Named{"release.gripper_jitter_s", c.release.gripper_jitter_s},
      Named{"release.rehearsals", static_cast<double>(c.release.rehearsals)},
      Named{"release.drag_mps", c.release.drag_mps},
      Named{"release.drag_sigma_mps", c.release.drag_sigma_mps},
      Named{"measure.rest", seconds(c.measure.rest)},
      Named{"alignment.stopping_lag_s", c.alignment.stopping_lag_s},
      Named{"gyro.bias_drift_radps_per_sqrt_s", c.gyro.bias_drift_radps_per_sqrt_s},
      Named{"gyro.scale_noise_rad_per_sqrt_rad", c.gyro.scale_noise_rad_per_sqrt_rad},
      Named{"gyro.timing_sigma_s", c.gyro.timing_sigma_s},
      Named{"odometry.speed_delay_s", c.odometry.speed_delay_s},
      Named{"odometry.creep_sigma_s2pm", c.odometry.creep_sigma_s2pm},
      Named{"odometry.scale_drift_per_sqrt_m", c.odometry.scale_drift_per_sqrt_m},
      Named{"run.max_lateral_heading_rad", c.run.max_lateral_heading_rad},
      Named{"safety.reaction_s", c.safety.reaction_s},
  };
  for (const Named& value : values) {
    if (!(std::isfinite(value.value) && value.value >= 0.0)) return std::string(value.name) + " must not be negative";
  }
  return std::nullopt;
}

std::optional<std::string> no_rotation(const AlignmentConfig& alignment) {
  using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor3> cRb(alignment.near_cRb.data());
  const double deviation = (cRb * cRb.transpose() - RowMajor3::Identity()).cwiseAbs().maxCoeff();
  const double handedness = cRb.row(0).cross(cRb.row(1)).dot(cRb.row(2));
  if (!(deviation < 1e-6) || !(handedness > 0.0)) return "alignment.near_cRb is not a rotation";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> refusal(const ThrowerConfig& config, const ShotOrder& order) {
  if (auto reason = not_positive(config)) return reason;
  if (auto reason = negative(config)) return reason;
  if (auto reason = no_rotation(config.alignment)) return reason;
  const double stone_m = stone_distance_m(config.release.hog_distance_m, 0.0, config.release);
  if (!(stone_m >= stone_to_hog_line_m)) {
    return "release.hog_distance_m less release.stone_x_m must leave the stone's radius before the hog line";
  }
  if (!positive(order.speed_mps) || order.speed_mps > config.limits.max_speed_mps) {
    return "the ordered speed is not within the robot's";
  }
  if (!(std::abs(order.heading_rad) < std::numbers::pi / 4.0)) return "the ordered heading is not down the sheet";
  if (!(std::isfinite(order.spin_radps) && order.spin_radps >= 0.0)) return "the ordered spin is not a magnitude";
  constexpr double most_aside_m = 1.0;
  if (order.release_x_m && !(std::abs(*order.release_x_m) <= most_aside_m)) {
    return "the ordered place of the release is not near the centre line";
  }
  return std::nullopt;
}

double needed_run_m(const ThrowerConfig& config, double speed_mps) {
  const SpeedProfile profile(speed_mps, config.limits.max_acceleration_mps2, config.limits.max_jerk_mps3);
  return profile.distance_m() + config.run.hold_distance_m;
}

}  // namespace hogline::servo
