// A plain throw for tests: everything exact, nothing disturbed. Cases change what they are about.
#pragma once

#include "hw/sim/scenario.hpp"

namespace hogline::hw::sim {

inline Scenario exact_scenario() {
  Scenario scenario;
  scenario.seed = 1;
  scenario.robot = {.mass_kg = 100.0,
                    .yaw_inertia_kgm2 = 12.0,
                    .wheel_radius_m = 0.1,
                    .track_m = 0.5,
                    .friction_coefficient = 0.3,
                    .rolling_resistance = 0.01,
                    .yaw_disturbance_reference_mps = 2.0,
                    .yaw_disturbance_time_s = 0.5,
                    .pitch_rad_per_mps2 = 0.004,
                    .pitch_natural_hz = 3.0,
                    .pitch_damping_ratio = 0.2,
                    .start_y_m = -3.658};
  scenario.stone = {.mass_kg = 18.0,
                    .radius_m = 0.145,
                    .stone_x_m = 0.6,
                    .release_drag_mps = 0.002,
                    .front_clearance_m = 0.01,
                    .side_clearance_m = 0.03,
                    .finger_reach_m = 0.15,
                    .friction_scale = 1.0,
                    .curl_gain = 1.0,
                    .spin_decay_scale = 1.0};
  scenario.gripper = {.opening_delay_s = 0.075,
                      .opening_jitter_s = 0.002,
                      .motion_delay_s = 0.02,
                      .holds_stone_at_start = true,
                      .activation_time_s = 2.0,
                      .full_stroke_time_s = 0.6};
  scenario.belt = {.acceleration_radps2 = 4.0, .max_speed_radps = 3.0, .watchdog_s = 0.2};
  scenario.arm = {.travel_time_s = 1.5, .unfolded_at_start = true, .watchdog_s = 0.2};
  scenario.gyro = {.line_rate_hz = 100.0, .latency_s = 0.003};
  return scenario;
}

}  // namespace hogline::hw::sim
