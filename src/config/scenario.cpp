#include "src/config/scenario.hpp"

#include <cmath>
#include <utility>

#include "src/config/scenario_ranges.hpp"
#include "src/config/section.hpp"
#include "src/config/strict_yaml.hpp"

namespace hogline::config {
namespace {

using namespace hw::sim;
using nlohmann::json;

Reflectance read_colour(const json& c) { return {c[0], c[1], c[2]}; }

hw::sim::SidelineKind read_sideline(const std::string& word) {
  if (word == "line") return hw::sim::SidelineKind::line;
  if (word == "bumper") return hw::sim::SidelineKind::bumper;
  if (word == "rope") return hw::sim::SidelineKind::rope;
  return hw::sim::SidelineKind::none;
}

SheetScenario read_sheet(const Section& s) {
  SheetScenario sheet;
  sheet.width_m = s.number("width_m");
  sheet.sideline = read_sideline(s.word("sideline"));
  sheet.sideline_width_m = s.number("sideline_width_m");
  sheet.neighbours = s.flag("neighbours");
  sheet.paint_depth_m = s.number("paint_depth_m");
  sheet.refractive_index = s.number("refractive_index");
  sheet.pebble_contrast = s.number("pebble_contrast");
  for (std::size_t i = 0; i < sheet.rings.size(); ++i) sheet.rings[i] = read_colour(s.raw("rings")[i]);
  sheet.ice = read_colour(s.raw("ice"));
  sheet.hog_line = read_colour(s.raw("hog_line"));
  sheet.thin_lines = read_colour(s.raw("thin_lines"));
  sheet.sideline_colour = read_colour(s.raw("sideline_colour"));
  return sheet;
}

RobotScenario read_robot(const Section& s) {
  RobotScenario r;
  r.mass_kg = s.number("mass_kg");
  r.mass_x_m = s.number("mass_x_m");
  r.mass_z_m = s.number("mass_z_m");
  r.runner_x_m = s.number("runner_x_m");
  r.yaw_inertia_kgm2 = s.number("yaw_inertia_kgm2");
  r.left_radius_error = s.number("left_radius_error");
  r.right_radius_error = s.number("right_radius_error");
  r.track_error = s.number("track_error");
  r.friction_coefficient = s.number("friction_coefficient");
  r.creep = s.number("creep");
  r.rolling_resistance = s.number("rolling_resistance");
  r.steering_bias_rad_per_m = s.radians("steering_bias_deg_per_m");
  r.yaw_disturbance_radps = s.number("yaw_disturbance_radps");
  r.yaw_disturbance_reference_mps = s.number("yaw_disturbance_reference_mps");
  r.yaw_disturbance_time_s = s.number("yaw_disturbance_time_s");
  r.pitch_rad_per_mps2 = s.radians("pitch_deg_per_mps2");
  r.pitch_natural_hz = s.number("pitch_natural_hz");
  r.pitch_damping_ratio = s.number("pitch_damping_ratio");
  r.start_x_m = s.number("start_x_m");
  r.start_y_m = s.number("start_y_m");
  r.start_yaw_rad = s.radians("start_yaw_deg");
  return r;
}

StoneScenario read_stone(const Section& s) {
  StoneScenario stone;
  stone.mass_kg = s.number("mass_kg");
  stone.radius_m = s.number("radius_m");
  stone.release_drag_mps = s.number("release_drag_mps");
  stone.front_clearance_m = s.number("front_clearance_m");
  stone.side_clearance_m = s.number("side_clearance_m");
  stone.finger_reach_m = s.number("finger_reach_m");
  stone.friction_scale = s.number("friction_scale");
  stone.curl_gain = s.number("curl_gain");
  stone.lateral_acceleration_mps2 = s.number("lateral_acceleration_mps2");
  stone.spin_decay_scale = s.number("spin_decay_scale");
  stone.throw_friction_sigma = s.number("throw_friction_sigma");
  stone.lane_friction = s.number("lane_friction");
  stone.restitution = s.number("restitution");
  stone.stone_friction = s.number("stone_friction");
  for (const auto& place : s.raw("others")) stone.others.push_back({place[0], place[1]});
  return stone;
}

GripperScenario read_gripper(const Section& s) {
  return {.opening_delay_s = s.number("opening_delay_s"),
          .opening_jitter_s = s.number("opening_jitter_s"),
          .motion_delay_s = s.number("motion_delay_s"),
          .holds_stone_at_start = true,
          .activation_time_s = s.number("activation_time_s"),
          .full_stroke_time_s = s.number("full_stroke_time_s")};
}

GyroScenario read_gyro(const Section& s) {
  constexpr double hour_s = 3600.0;
  return {.line_rate_hz = s.number("line_rate_hz"),
          .bias_radps = s.radians("bias_deg_per_h") / hour_s,
          .scale_error = s.number("scale_error"),
          .angle_random_walk_rad_per_sqrt_s = s.radians("angle_random_walk_deg_per_sqrt_h") / std::sqrt(hour_s),
          .latency_s = s.number("latency_s"),
          .latitude_rad = s.radians("latitude_deg")};
}

CameraScenario read_camera(const Section& s) {
  return {.rate_hz = s.number("rate_hz"),
          .exposure_s = s.number("exposure_s"),
          .latency_s = s.number("latency_s"),
          .latency_jitter_s = s.number("latency_jitter_s"),
          .electrons_full_scale = s.number("electrons_full_scale"),
          .read_noise_electrons = s.number("read_noise_electrons"),
          .pitch_error_rad = s.radians("pitch_error_deg")};
}

SkipScenario read_skip(const Section& s) {
  SkipScenario skip;
  skip.x_m = s.number("x_m");
  skip.y_m = s.number("y_m");
  skip.yaw_rad = s.radians("yaw_deg");
  skip.head = {.bandwidth_hz = s.number("bandwidth_hz"), .dead_time_s = s.number("dead_time_s")};
  skip.pan_zero_error_rad = s.radians("pan_zero_error_deg");
  skip.tilt_zero_error_rad = s.radians("tilt_zero_error_deg");
  skip.far_yaw_error_rad = s.radians("far_yaw_error_deg");
  skip.far_roll_error_rad = s.radians("far_roll_error_deg");
  skip.far_camera = read_camera(s.section("far_camera"));
  skip.sweepers = s.integer("sweepers");
  for (const auto& passer : s.raw("passers")) skip.passers.push_back({passer[0], passer[1]});
  return skip;
}

}  // namespace

struct ScenarioFile::Content {
  json root;
  ScenarioRanges ranges;
};

ScenarioFile::ScenarioFile(std::string_view text, const std::string& name) {
  Document document{.file = name, .lines = {}};
  json root = read_yaml(text, document);
  ScenarioRanges ranges(root, document);
  content_ = std::make_shared<const Content>(Content{std::move(root), std::move(ranges)});
}

Scenario ScenarioFile::draw(std::uint64_t seed) const {
  json root = content_->root;
  content_->ranges.draw(root, seed);
  const Section s(root);

  Scenario scenario;
  scenario.seed = seed;
  scenario.sheet = read_sheet(s.section("sheet"));
  scenario.light = {.level = s.section("light").number("level"),
                    .falloff_per_m = s.section("light").number("falloff_per_m"),
                    .lamp_gloss = s.section("light").number("lamp_gloss")};
  scenario.people = {.count = s.section("people").integer("count"),
                     .nearest_x_m = s.section("people").number("nearest_x_m"),
                     .walk_mps = s.section("people").number("walk_mps")};
  scenario.robot = read_robot(s.section("robot"));
  scenario.drive = {.bandwidth_hz = s.section("drive").number("bandwidth_hz"),
                    .dead_time_s = s.section("drive").number("dead_time_s")};
  scenario.stone = read_stone(s.section("stone"));
  scenario.gripper = read_gripper(s.section("gripper"));
  scenario.belt = {.acceleration_radps2 = s.section("belt").number("acceleration_radps2"),
                   .max_speed_radps = s.section("belt").number("max_speed_radps"),
                   .watchdog_s = s.section("belt").number("watchdog_s")};
  scenario.arm = {.travel_time_s = s.section("arm").number("travel_time_s"),
                  .unfolded_at_start = s.section("arm").flag("unfolded_at_start"),
                  .watchdog_s = s.section("arm").number("watchdog_s")};
  scenario.gyro = read_gyro(s.section("gyro"));
  scenario.near_camera = read_camera(s.section("near_camera"));
  scenario.low_camera = read_camera(s.section("low_camera"));
  if (s.has("skip")) scenario.skip = read_skip(s.section("skip"));
  return scenario;
}

Scenario load_scenario(const std::string& path, std::uint64_t seed) {
  return parse_scenario(read_file(path), path, seed);
}

Scenario parse_scenario(std::string_view text, const std::string& name, std::uint64_t seed) {
  return ScenarioFile(text, name).draw(seed);
}

}  // namespace hogline::config
