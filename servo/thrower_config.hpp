// The numbers the thrower's controller needs, all from the rig file. No defaults: each is set or the rig is refused.
#pragma once

#include <array>

#include "servo/yaw_bias.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

/// The two-wheeled base.
struct BaseGeometry {
  double wheel_radius_m = 0.0;
  double track_m = 0.0;  ///< between the wheels' contact points
};

struct MotionLimits {
  double max_speed_mps = 0.0;
  double max_acceleration_mps2 = 0.0;
  double max_jerk_mps3 = 0.0;
  double max_deceleration_mps2 = 0.0;  ///< after the release; what a quick stop is sure to reach
  double max_yaw_rate_radps = 0.0;
  double max_yaw_acceleration_radps2 = 0.0;
};

/// Where and how the stone is let go.
struct ReleaseConfig {
  double hog_distance_m = 0.0;   ///< of b's origin when the stone shall leave the jaws
  double tolerance_m = 0.0;      ///< outside release plane +- tolerance the stone is kept
  double stone_x_m = 0.0;        ///< the held stone's centre in b, ahead of the origin
  double gripper_delay_s = 0.0;  ///< from the command to the stone being free
  double gripper_delay_sigma_s = 0.0;
  double gripper_jitter_s = 0.0;  ///< by which one delay differs from the next, one standard deviation
  int rehearsals = 0;             ///< so often the jaws are tried on the standing stone before the run
  double drag_mps = 0.0;          ///< by so much the stone is slower than the body that let it go
  double drag_sigma_mps = 0.0;
  double rest_hog_distance_m = 0.0;  ///< where the body's origin shall come to rest; negative: beyond the line
};

/// How old an input may be before the robot stops.
struct AgeLimits {
  Duration wheels{};
  Duration gyro{};
  Duration gripper{};
  Duration arm{};
  Duration near_view{};  ///< while measuring and aligning
  Duration low_view{};   ///< while the low view is the source of the distance
  Duration low_sight{};  ///< ... since it last saw the hog line, where it must be in sight
};

/// What the robot rests on before it turns.
struct MeasureConfig {
  int frames = 0;   ///< near views, seen while the robot stands, that one measurement of its place is made of
  Duration rest{};  ///< how long the gyro's bias is learnt at rest, at least
};

enum class AlignmentMethod {
  visual_servoing,  ///< the near view closes the loop, the gyro carries it from look to look
  look_then_gyro,   ///< the paper's: one measurement before the turn, then the gyro alone
};

/// The turn on the spot. ViSP's adaptive gain: `gain_at_zero` for small errors, `gain_at_infinity` for large ones.
struct AlignmentConfig {
  AlignmentMethod method = AlignmentMethod::visual_servoing;
  std::array<double, 9> near_cRb{};  ///< near camera's rotation: b-directions to camera directions, row by row
  double gain_at_zero_per_s = 0.0;
  double gain_at_infinity_per_s = 0.0;
  double gain_slope_per_s_rad = 0.0;      ///< how fast the gain falls with the error, at zero
  double tolerance_rad = 0.0;             ///< settled: heading error below this,
  double rate_tolerance_radps = 0.0;      ///< rate of turn below this,
  Duration settle_time{};                 ///< for this long
  double breakaway_yaw_rate_radps = 0.0;  ///< the slowest ordered turn that is sure to overcome stiction
  double stopping_lag_s = 0.0;            ///< the body turns on for about this long after a turn is no longer ordered
  YawBiasTable near_yaw_bias{};           ///< of the near view, by a turn on the spot; may be empty
};

struct GyroConfig {
  double noise_rad_per_sqrt_s = 0.0;  ///< angle random walk
  double bias_sigma_radps = 0.0;      ///< what the bias may be before it is learnt
  double bias_drift_radps_per_sqrt_s = 0.0;
  double scale_noise_rad_per_sqrt_rad = 0.0;  ///< error of the gyro's scale, as a random walk over the angle turned
  double timing_sigma_s = 0.0;                ///< how far a picture's and the gyro's stamps can be apart
};

struct OdometryConfig {
  double scale_sigma = 0.0;             ///< of true over measured distance, before it is learnt
  double scale_drift_per_sqrt_m = 0.0;  ///< wear, slip that changes with the acceleration
  double creep_sigma_s2pm = 0.0;        ///< share of its way that a wheel turns in vain, per acceleration
  double noise_m_per_sqrt_m = 0.0;      ///< random walk of the travelled distance
  double speed_delay_s = 0.0;           ///< the wheels' speeds are those of so long before their stamp
};

/// The run to the release plane, and when a release is still worth it.
struct RunConfig {
  double sight_from_hog_m = 0.0;  ///< from this distance of b's origin the hog line must be in sight of the low camera,
  double sight_to_hog_m = 0.0;    ///< to this one
  double hold_distance_m = 0.0;   ///< the shot's speed is reached at least this far before the release plane
  double heading_gain_per_s = 0.0;
  double lateral_length_m = 0.0;         ///< a lateral offset is run down over this length
  double max_lateral_heading_rad = 0.0;  ///< the heading given up for the offset, at most
  double speed_tolerance_mps = 0.0;
  double heading_tolerance_rad = 0.0;
  double lateral_tolerance_m = 0.0;
  double spin_tolerance_radps = 0.0;
};

/// The supervisor's bounds. They are bounds, not standard deviations: beyond them something is wrong.
struct SafetyConfig {
  double max_yaw_rate_disagreement_radps = 0.0;  ///< between gyro and wheels
  Duration disagreement_time{};                  ///< how long it may last
  double reaction_s = 0.0;                       ///< from the decision to brake to full braking
  double speed_margin = 0.0;        ///< share of a limit by which a measured or ordered speed may exceed it
  double odometry_bound = 0.0;      ///< share by which the wheels' distance can be wrong while they roll
  double look_sigmas = 0.0;         ///< a look at the hog line is off by no more than so many of its sigmas
  double look_margin_m = 0.0;       ///< ... and this
  double slip_allowance_m = 0.0;    ///< by so much the wheels may have slipped between two looks
  double max_travel_m = 0.0;        ///< of the wheels, forward, from arming to the release
  double max_overrun_m = 0.0;       ///< of the body's origin beyond the hog line
  double max_tilt_rad = 0.0;        ///< of the body against the ice, as the cameras see it
  Duration operator_age{};          ///< of the dead-man's switch's state
  std::array<double, 9> low_cRb{};  ///< low camera's rotation: b-directions to camera directions
};

/// How long a state may last. A state that lasts longer aborts the throw.
struct Deadlines {
  Duration unfold{};
  Duration rehearse{};
  Duration measure{};
  Duration align{};
  Duration fold{};
  Duration run{};
  Duration release{};  ///< from the release order to the jaws' own report that they open
  Duration brake{};
};

struct ThrowerConfig {
  BaseGeometry base;
  MotionLimits limits;
  ReleaseConfig release;
  AgeLimits ages;
  MeasureConfig measure;
  AlignmentConfig alignment;
  GyroConfig gyro;
  OdometryConfig odometry;
  RunConfig run;
  SafetyConfig safety;
  Deadlines deadlines;
};

}  // namespace hogline::servo
