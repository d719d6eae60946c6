// Everything that can be chosen about the simulated rink. Plain numbers, loaded from a scenario file: zero means "not
// set", nothing here is a default. Frames: b and e as in doc/notation.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace hogline::hw::sim {

enum class SidelineKind { line, bumper, rope, none };

/// Share of the light that a surface gives back, linear, 0..1.
struct Reflectance {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

struct SheetScenario {
  double width_m = 0.0;  ///< between the sidelines' inner edges
  SidelineKind sideline = SidelineKind::line;
  double sideline_width_m = 0.0;
  bool neighbours = false;  ///< sheets to the left and right are painted too
  double paint_depth_m = 0.0;
  double refractive_index = 0.0;
  double pebble_contrast = 0.0;      ///< standard deviation of the ice's brightness, share of its mean
  std::array<Reflectance, 4> rings;  ///< from the outermost ring to the button
  Reflectance ice;
  Reflectance hog_line;
  Reflectance thin_lines;  ///< centre, tee, back and courtesy lines
  Reflectance sideline_colour;
};

struct LightScenario {
  double level = 0.0;          ///< of full scale, a surface of reflectance 1 in the picture's middle
  double falloff_per_m = 0.0;  ///< relative change of the light per metre across the sheet
  double lamp_gloss = 0.0;     ///< brightness of the lamps' reflections in the ice, 0 for none
};

/// Spectators and sweepers along the sheet. Each stands, or walks to and fro beside the run, where the seed puts him.
struct PeopleScenario {
  int count = 0;
  double nearest_x_m = 0.0;  ///< of a person's middle from the centre line, at least
  double walk_mps = 0.0;     ///< how fast the fastest walks
};

/// The base: two driven wheels on one axle under b's origin, and a runner ahead of them that glides and carries its
/// share of the weight. The held stone lies on the ice: it must be moved, but gives the wheels no grip.
struct RobotScenario {
  double mass_kg = 0.0;            ///< without the stone
  double mass_x_m = 0.0;           ///< centre of mass ahead of the axle
  double mass_z_m = 0.0;           ///< ... above the ice
  double runner_x_m = 0.0;         ///< of the runner ahead of the axle; 0: the wheels carry all the weight
  double yaw_inertia_kgm2 = 0.0;   ///< about b's z axis, without the stone
  double wheel_radius_m = 0.0;     ///< what the rig file calls the radius
  double track_m = 0.0;            ///< what the rig file calls the track
  double left_radius_error = 0.0;  ///< true radius = nominal * (1 + error)
  double right_radius_error = 0.0;
  double track_error = 0.0;
  double friction_coefficient = 0.0;     ///< of the wheels on ice: studded 0.3-0.5, rubber 0.05-0.15
  double creep = 0.0;                    ///< slip of a wheel that pulls, share of its speed per unit of pull / weight
  double rolling_resistance = 0.0;       ///< force / weight, of wheels that roll free
  double steering_bias_rad_per_m = 0.0;  ///< turn left per metre driven that the wheels do not measure
  double yaw_disturbance_radps = 0.0;    ///< standard deviation of a wandering turn that the wheels do not measure,
  double yaw_disturbance_reference_mps = 0.0;  ///< at this speed; it grows in proportion to the speed
  double yaw_disturbance_time_s = 0.0;         ///< its correlation time
  double pitch_rad_per_mps2 = 0.0;             ///< the nose rises by this for each m/s2 of forward acceleration
  double pitch_natural_hz = 0.0;
  double pitch_damping_ratio = 0.0;
  double start_x_m = 0.0;  ///< of b's origin in e
  double start_y_m = 0.0;
  double start_yaw_rad = 0.0;
};

/// The wheel drives behind the bus.
struct DriveScenario {
  double bandwidth_hz = 0.0;  ///< of the velocity loop
  double dead_time_s = 0.0;
};

struct StoneScenario {
  double mass_kg = 0.0;
  double radius_m = 0.0;
  double stone_x_m = 0.0;          ///< the held stone's centre in b, ahead of the origin
  double release_drag_mps = 0.0;   ///< speed that the parting jaws take from the stone
  double front_clearance_m = 0.0;  ///< the stone touches the robot when it comes nearer to it by this much
  double side_clearance_m = 0.0;   ///< between the stone and an open finger on either side
  double finger_reach_m = 0.0;     ///< the stone is clear of the fingers when it is ahead of its held place by this
  double friction_scale = 0.0;     ///< of FCV1's friction
  double curl_gain = 0.0;          ///< of FCV1's curl
  double lateral_acceleration_mps2 = 0.0;  ///< towards e's +x, for a floor that is not level
  double spin_decay_scale = 0.0;
  double throw_friction_sigma = 0.0;  ///< standard deviation of the friction from throw to throw, share of it
  double lane_friction = 0.0;         ///< share by which the ice brakes more a metre beside the centre line than on it
  double restitution = 0.0;           ///< of two stones
  double stone_friction = 0.0;        ///< coefficient of friction between two stones
  std::vector<std::array<double, 2>> others{};  ///< stones that lie on the sheet: x and y in e
};

struct GripperScenario {
  double opening_delay_s = 0.0;   ///< from the command's arrival to the stone being free
  double opening_jitter_s = 0.0;  ///< standard deviation, drawn for each opening
  double motion_delay_s = 0.0;    ///< from the command's arrival to the first motion that the device reports
  bool holds_stone_at_start = false;
  double activation_time_s = 0.0;
  double full_stroke_time_s = 0.0;  ///< between open and closed
};

struct SpinBeltScenario {
  double acceleration_radps2 = 0.0;  ///< of the stone
  double max_speed_radps = 0.0;
  double watchdog_s = 0.0;
};

struct ArmScenario {
  double travel_time_s = 0.0;  ///< from folded to unfolded and back
  bool unfolded_at_start = false;
  double watchdog_s = 0.0;
};

struct GyroScenario {
  double line_rate_hz = 0.0;  ///< readings a second; the DSP-3000 gives 100 (text) or 1000 (binary) within 3 %
  double bias_radps = 0.0;
  double scale_error = 0.0;  ///< output = (1 + error) * rate + bias + noise
  double angle_random_walk_rad_per_sqrt_s = 0.0;
  double latency_s = 0.0;     ///< from the measured moment to the reading's last byte
  double latitude_rad = 0.0;  ///< of the hall: the gyro feels the earth turn
  bool binary = false;        ///< the variant with words instead of text
};

struct CameraScenario {
  double rate_hz = 0.0;
  double exposure_s = 0.0;
  double latency_s = 0.0;             ///< from the middle of the exposure to the frame's arrival
  double latency_jitter_s = 0.0;      ///< standard deviation
  double electrons_full_scale = 0.0;  ///< shot noise: variance = signal
  double read_noise_electrons = 0.0;
  double pitch_error_rad = 0.0;  ///< the true mount's pitch less the rig file's
};

/// Somebody who steps into the skip's line of sight to the thrown stone and goes along with it.
struct PasserScenario {
  double from_s = 0.0;  ///< after the release
  double for_s = 0.0;
};

/// The skip: a robot that stands behind the far house and looks at the stones that come. Frame e is the skip's.
struct SkipScenario {
  double x_m = 0.0;  ///< of b's origin in e
  double y_m = 0.0;
  double yaw_rad = 0.0;
  DriveScenario head;               ///< the loops of pan and tilt
  double pan_zero_error_rad = 0.0;  ///< true angle less what the encoder means
  double tilt_zero_error_rad = 0.0;
  CameraScenario far_camera;
  double far_yaw_error_rad = 0.0;  ///< of the true far mount
  double far_roll_error_rad = 0.0;
  int sweepers = 0;  ///< 0 to 2, who walk beside the thrown stone
  std::vector<PasserScenario> passers{};
};

struct Scenario {
  std::uint64_t seed = 0;
  SheetScenario sheet;
  LightScenario light;
  PeopleScenario people;
  RobotScenario robot;
  DriveScenario drive;
  StoneScenario stone;
  GripperScenario gripper;
  SpinBeltScenario belt;
  ArmScenario arm;
  GyroScenario gyro;
  CameraScenario near_camera;
  CameraScenario low_camera;
  std::optional<SkipScenario> skip{};
};

}  // namespace hogline::hw::sim
