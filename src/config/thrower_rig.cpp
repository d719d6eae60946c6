#include "src/config/thrower_rig.hpp"

#include <fmt/format.h>

#include <cmath>

#include "src/config/config_error.hpp"
#include "src/config/device_sections.hpp"
#include "src/config/schema.hpp"
#include "src/config/section.hpp"
#include "src/config/strict_yaml.hpp"
#include "vision/geometry/pose.hpp"

namespace hogline::config {
namespace {

using nlohmann::json;

constexpr double hour_s = 3600.0;

servo::MotionLimits read_limits(const Section& s) {
  return {.max_speed_mps = s.number("max_speed_mps"),
          .max_acceleration_mps2 = s.number("max_acceleration_mps2"),
          .max_jerk_mps3 = s.number("max_jerk_mps3"),
          .max_deceleration_mps2 = s.number("max_deceleration_mps2"),
          .max_yaw_rate_radps = s.radians("max_yaw_rate_degps"),
          .max_yaw_acceleration_radps2 = s.radians("max_yaw_acceleration_degps2")};
}

servo::AgeLimits read_ages(const Section& s) {
  return {.wheels = s.duration("wheels_s"),
          .gyro = s.duration("gyro_s"),
          .gripper = s.duration("gripper_s"),
          .arm = s.duration("arm_s"),
          .near_view = s.duration("near_view_s"),
          .low_view = s.duration("low_view_s"),
          .low_sight = s.duration("low_sight_s")};
}

std::array<double, 9> rotation_cRb(const vision::Mount& mount) {
  const Eigen::Matrix3d cRb = vision::bMc(mount).linear().transpose();
  std::array<double, 9> rows{};
  for (int i = 0; i < 9; ++i) rows[static_cast<std::size_t>(i)] = cRb(i / 3, i % 3);
  return rows;
}

servo::YawBiasTable read_yaw_bias(const json& list) {
  constexpr double deg = std::numbers::pi / 180.0;
  servo::YawBiasTable table;
  for (const json& knot : list) table.push_back({knot[0].get<double>() * deg, knot[1].get<double>() * deg});
  return table;
}

servo::AlignmentConfig read_alignment(const Section& s, const vision::Mount& near_mount) {
  servo::AlignmentConfig a;
  a.method = s.word("method") == "look_then_gyro" ? servo::AlignmentMethod::look_then_gyro
                                                  : servo::AlignmentMethod::visual_servoing;
  a.near_cRb = rotation_cRb(near_mount);
  a.near_yaw_bias = read_yaw_bias(s.raw("near_yaw_bias_deg"));
  a.gain_at_zero_per_s = s.number("gain_at_zero_per_s");
  a.gain_at_infinity_per_s = s.number("gain_at_infinity_per_s");
  a.gain_slope_per_s_rad = s.number("gain_slope_per_s_deg") / (std::numbers::pi / 180.0);
  a.tolerance_rad = s.radians("tolerance_deg");
  a.rate_tolerance_radps = s.radians("rate_tolerance_degps");
  a.settle_time = s.duration("settle_time_s");
  a.breakaway_yaw_rate_radps = s.radians("breakaway_yaw_rate_degps");
  a.stopping_lag_s = s.number("stopping_lag_s");
  return a;
}

servo::RunConfig read_run(const Section& s) {
  return {.sight_from_hog_m = s.number("sight_from_hog_m"),
          .sight_to_hog_m = s.number("sight_to_hog_m"),
          .hold_distance_m = s.number("hold_distance_m"),
          .heading_gain_per_s = s.number("heading_gain_per_s"),
          .lateral_length_m = s.number("lateral_length_m"),
          .max_lateral_heading_rad = s.radians("max_lateral_heading_deg"),
          .speed_tolerance_mps = s.number("speed_tolerance_mps"),
          .heading_tolerance_rad = s.radians("heading_tolerance_deg"),
          .lateral_tolerance_m = s.number("lateral_tolerance_m"),
          .spin_tolerance_radps = s.number("spin_tolerance_radps")};
}

servo::Deadlines read_deadlines(const Section& s) {
  return {.unfold = s.duration("unfold_s"),
          .rehearse = s.duration("rehearse_s"),
          .measure = s.duration("measure_s"),
          .align = s.duration("align_s"),
          .fold = s.duration("fold_s"),
          .run = s.duration("run_s"),
          .release = s.duration("release_s"),
          .brake = s.duration("brake_s")};
}

servo::SafetyConfig read_safety(const Section& s, const vision::Mount& low_mount) {
  return {.max_yaw_rate_disagreement_radps = s.radians("max_yaw_rate_disagreement_degps"),
          .disagreement_time = s.duration("disagreement_time_s"),
          .reaction_s = s.number("reaction_s"),
          .speed_margin = s.number("speed_margin"),
          .odometry_bound = s.number("odometry_bound"),
          .look_sigmas = s.number("look_sigmas"),
          .look_margin_m = s.number("look_margin_m"),
          .slip_allowance_m = s.number("slip_allowance_m"),
          .max_travel_m = s.number("max_travel_m"),
          .max_overrun_m = s.number("max_overrun_m"),
          .max_tilt_rad = s.radians("max_tilt_deg"),
          .operator_age = s.duration("operator_age_s"),
          .low_cRb = rotation_cRb(low_mount)};
}

servo::ThrowerConfig read_thrower(const Section& root, const vision::Mount& near_mount,
                                  const vision::Mount& low_mount) {
  const Section t = root.section("thrower");
  const Section release = root.section("release");
  servo::ThrowerConfig c;
  c.base = {.wheel_radius_m = root.section("base").number("wheel_radius_m"),
            .track_m = root.section("base").number("track_m")};
  c.limits = read_limits(root.section("limits"));
  c.release = {.hog_distance_m = release.number("hog_distance_m"),
               .tolerance_m = release.number("tolerance_m"),
               .stone_x_m = release.number("stone_x_m"),
               .gripper_delay_s = release.number("gripper_delay_s"),
               .gripper_delay_sigma_s = release.number("gripper_delay_sigma_s"),
               .gripper_jitter_s = release.number("gripper_jitter_s"),
               .rehearsals = release.integer("rehearsals"),
               .drag_mps = release.number("drag_mps"),
               .drag_sigma_mps = release.number("drag_sigma_mps"),
               .rest_hog_distance_m = release.number("rest_hog_distance_m")};
  c.ages = read_ages(root.section("ages"));
  c.measure = {.frames = t.section("measure").integer("frames"), .rest = t.section("measure").duration("rest_s")};
  c.alignment = read_alignment(t.section("alignment"), near_mount);
  const Section gyro = t.section("gyro");
  c.gyro = {.noise_rad_per_sqrt_s = gyro.radians("noise_deg_per_sqrt_h") / std::sqrt(hour_s),
            .bias_sigma_radps = gyro.radians("bias_sigma_deg_per_h") / hour_s,
            .bias_drift_radps_per_sqrt_s = gyro.radians("bias_drift_deg_per_h_per_sqrt_s") / hour_s,
            .scale_noise_rad_per_sqrt_rad = gyro.number("scale_noise_rad_per_sqrt_rad"),
            .timing_sigma_s = gyro.number("timing_sigma_s")};
  const Section odometry = t.section("odometry");
  c.odometry = {.scale_sigma = odometry.number("scale_sigma"),
                .scale_drift_per_sqrt_m = odometry.number("scale_drift_per_sqrt_m"),
                .creep_sigma_s2pm = odometry.number("creep_sigma_s2pm"),
                .noise_m_per_sqrt_m = odometry.number("noise_m_per_sqrt_m"),
                .speed_delay_s = odometry.number("speed_delay_s")};
  c.run = read_run(t.section("run"));
  c.safety = read_safety(t.section("safety"), low_mount);
  c.deadlines = read_deadlines(t.section("deadlines"));
  return c;
}

void require_sections(const json& root, const Document& document) {
  for (const char* name :
       {"base", "limits", "release", "ages", "thrower", "drive", "modbus", "gripper", "arm", "gyro", "looks"}) {
    if (!root.contains(name)) {
      throw ConfigError(document.file, 0, name, "",
                        "missing; a throw needs this section (see config/rigs/practice.yaml)");
    }
  }
}

// The rules let nobody hold the stone nearer to the line than its radius; the rig file must leave that room.
void check_release(const servo::ReleaseConfig& r, const Document& document) {
  const double nearest_m = r.hog_distance_m - r.tolerance_m - r.stone_x_m;
  if (nearest_m < vision::rules::stone_radius_m) {
    throw ConfigError(
        document.file, document.line_of("release"), "release", "",
        fmt::format("hog_distance_m - tolerance_m - stone_x_m is {:.3f}; must be at least {} (the stone's "
                    "centre must leave the jaws a radius before the hog line)",
                    nearest_m, vision::rules::stone_radius_m));
  }
}

void check_yaw_bias(const servo::YawBiasTable& table, const Document& document) {
  for (std::size_t i = 1; i < table.size(); ++i) {
    if (table[i].estimate_rad > table[i - 1].estimate_rad) continue;
    const char* key = "thrower.alignment.near_yaw_bias_deg";
    throw ConfigError(document.file, document.line_of(key), key, fmt::format("knot {}", i + 1),
                      "the seen angles must ascend");
  }
}

// While a look goes on nobody asks the camera: a limit shorter than that would take it for silence.
void check_looks(const ThrowerRig& rig, const Document& document) {
  for (const auto& [name, look] : {std::pair("near", rig.looks.near), std::pair("low", rig.looks.low)}) {
    const std::string key = fmt::format("cameras.{}.source.silence_limit_s", name);
    if (rig.rig.source(name).silence_limit > look) continue;
    throw ConfigError(document.file, document.line_of(key), key, "",
                      fmt::format("must be longer than looks.{}_s, {} s", name, seconds(look)));
  }
}

}  // namespace

DeviceRig devices_of(const ThrowerRig& rig) {
  return {.rig = rig.rig,
          .drive = rig.drive,
          .head = rig.head,
          .modbus = rig.modbus,
          .gripper = rig.gripper,
          .arm = rig.arm,
          .gyro = GyroSection{.device = rig.gyro, .port = rig.gyro_port},
          .link = rig.link,
          .operator_socket = rig.operator_socket};
}

ThrowerRig load_thrower_rig(const std::string& path) { return parse_thrower_rig(read_file(path), path); }

ThrowerRig parse_thrower_rig(std::string_view text, const std::string& name) {
  ThrowerRig rig;
  rig.rig = parse_rig(text, name);
  Document document{.file = name, .lines = {}};
  const json root = read_yaml(text, document);
  require_sections(root, document);
  const Section s(root);
  rig.thrower = read_thrower(s, rig.rig.camera("near").mount, rig.rig.camera("low").mount);
  check_release(rig.thrower.release, document);
  check_yaw_bias(rig.thrower.alignment.near_yaw_bias, document);
  const DeviceRig devices = read_devices(rig.rig, s, document);
  rig.drive = devices.drive.value();
  rig.head = devices.head;
  rig.modbus = devices.modbus.value();
  rig.gripper = devices.gripper.value();
  rig.arm = devices.arm.value();
  rig.gyro = devices.gyro.value().device;
  rig.gyro_port = devices.gyro.value().port;
  rig.link = devices.link;
  rig.operator_socket = devices.operator_socket;
  rig.looks = {.near = s.section("looks").duration("near_s"),
               .low = s.section("looks").duration("low_s"),
               .tracked = s.section("looks").duration("tracked_s")};
  check_looks(rig, document);
  return rig;
}

}  // namespace hogline::config
