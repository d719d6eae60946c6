// The numbers of a thrower as the tests use them.
#pragma once

#include <cmath>
#include <numbers>

#include "servo/shot.hpp"
#include "servo/thrower_config.hpp"

namespace hogline::servo::test {

inline constexpr double degree = std::numbers::pi / 180.0;
inline constexpr std::chrono::milliseconds period{5};

/// Rotation from b to a camera that looks along b's x axis, turned left by `yaw_rad` and down by `pitch_rad`.
inline std::array<double, 9> camera_rotation(double pitch_rad, double yaw_rad) {
  const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad), cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
  // Rows: the camera's right, down and forward axes in b.
  return {sy, -cy, 0.0, -cy * sp, -sy * sp, -cp, cy * cp, sy * cp, -sp};
}

inline ThrowerConfig thrower_config() {
  using namespace std::chrono_literals;
  ThrowerConfig c;
  c.base = {.wheel_radius_m = 0.1, .track_m = 0.5};
  c.limits = {.max_speed_mps = 3.5,
              .max_acceleration_mps2 = 1.0,
              .max_jerk_mps3 = 3.0,
              .max_deceleration_mps2 = 2.0,
              .max_yaw_rate_radps = 0.35,
              .max_yaw_acceleration_radps2 = 1.0};
  c.release = {.hog_distance_m = 1.0,
               .tolerance_m = 0.1,
               .stone_x_m = 0.45,
               .gripper_delay_s = 0.075,
               .gripper_delay_sigma_s = 0.003,
               .gripper_jitter_s = 0.002,
               .rehearsals = 0,
               .drag_mps = 0.0,
               .drag_sigma_mps = 0.002,
               .rest_hog_distance_m = -0.5};
  c.ages = {.wheels = 20ms,
            .gyro = 30ms,
            .gripper = 150ms,
            .arm = 300ms,
            .near_view = 120ms,
            .low_view = 120ms,
            .low_sight = 500ms};
  c.measure = {.frames = 15, .rest = 1s};
  c.alignment = {.method = AlignmentMethod::visual_servoing,
                 .near_cRb = camera_rotation(28.0 * degree, 0.0),
                 .gain_at_zero_per_s = 4.0,
                 .gain_at_infinity_per_s = 2.0,
                 .gain_slope_per_s_rad = 30.0,
                 .tolerance_rad = 0.03 * degree,
                 .rate_tolerance_radps = 0.1 * degree,
                 .settle_time = 300ms,
                 .breakaway_yaw_rate_radps = 0.6 * degree,
                 .stopping_lag_s = 0.04};
  c.gyro = {.noise_rad_per_sqrt_s = 3e-5,
            .bias_sigma_radps = 0.01,
            .bias_drift_radps_per_sqrt_s = 1e-6,
            .scale_noise_rad_per_sqrt_rad = 1e-3,
            .timing_sigma_s = 2e-3};
  c.odometry = {
      .scale_sigma = 0.02, .scale_drift_per_sqrt_m = 0.0005, .creep_sigma_s2pm = 0.0, .noise_m_per_sqrt_m = 0.001};
  c.run = {.sight_from_hog_m = 4.4,
           .sight_to_hog_m = 1.7,
           .hold_distance_m = 0.8,
           .heading_gain_per_s = 8.0,
           .lateral_length_m = 2.0,
           .max_lateral_heading_rad = 1.0 * degree,
           .speed_tolerance_mps = 0.12,
           .heading_tolerance_rad = 0.6 * degree,
           .lateral_tolerance_m = 0.1,
           .spin_tolerance_radps = 0.3};
  c.safety = {.max_yaw_rate_disagreement_radps = 0.2,
              .disagreement_time = 150ms,
              .reaction_s = 0.06,
              .speed_margin = 0.1,
              .odometry_bound = 0.03,
              .look_sigmas = 4.0,
              .look_margin_m = 0.02,
              .slip_allowance_m = 0.15,
              .max_travel_m = 14.0,
              .max_overrun_m = 5.0,
              .max_tilt_rad = 3.0 * degree,
              .operator_age = 300ms,
              .low_cRb = camera_rotation(20.0 * degree, 0.0)};
  c.deadlines = {
      .unfold = 6s, .rehearse = 6s, .measure = 5s, .align = 8s, .fold = 6s, .run = 10s, .release = 300ms, .brake = 5s};
  return c;
}

inline ShotOrder draw() {
  return {.speed_mps = 2.09, .heading_rad = 0.4 * degree, .curl = Curl::counter_clockwise, .spin_radps = 1.5};
}

}  // namespace hogline::servo::test
