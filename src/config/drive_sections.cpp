#include "src/config/drive_sections.hpp"

#include "src/config/config_error.hpp"

namespace hogline::config {
namespace {

hw::DrivePlausibility read_plausibility(const Section& s) {
  return {.standstill_radps = s.number("standstill_radps"),
          .speed_error_radps = s.number("speed_error_radps"),
          .speed_error_time = s.duration("speed_error_time_s"),
          .position_mismatch_rad = s.number("position_mismatch_rad")};
}

hw::HeadAxisConfig read_head_axis(const Section& s, const std::string& name) {
  return {.identity = {.name = name,
                       .node = static_cast<std::uint8_t>(s.integer("node")),
                       .vendor_id = s.raw("vendor_id").get<std::uint32_t>(),
                       .product_code = s.raw("product_code").get<std::uint32_t>()},
          .gearing = {.direction = s.integer("direction"),
                      .gear_ratio = s.number("gear_ratio"),
                      .position_counts_per_motor_rev = s.number("position_counts_per_motor_rev"),
                      .velocity_units_per_motor_rps = s.number("velocity_units_per_motor_rps"),
                      .acceleration_units_per_motor_rps2 = s.number("acceleration_units_per_motor_rps2")},
          .zero_counts = s.integer("zero_counts"),
          .min_rad = s.radians("min_deg"),
          .max_rad = s.radians("max_deg"),
          .max_speed_radps = s.radians("max_speed_degps"),
          .acceleration_radps2 = s.radians("acceleration_degps2"),
          .quick_stop_radps2 = s.radians("quick_stop_degps2"),
          .tolerance_rad = s.radians("tolerance_deg")};
}

hw::WheelConfig read_wheel(const Section& s, const std::string& name) {
  hw::WheelConfig w;
  w.name = name;
  w.node = static_cast<std::uint8_t>(s.integer("node"));
  w.vendor_id = s.raw("vendor_id").get<std::uint32_t>();
  w.product_code = s.raw("product_code").get<std::uint32_t>();
  w.direction = s.integer("direction");
  w.gear_ratio = s.number("gear_ratio");
  w.position_counts_per_motor_rev = s.number("position_counts_per_motor_rev");
  w.velocity_units_per_motor_rps = s.number("velocity_units_per_motor_rps");
  w.acceleration_units_per_motor_rps2 = s.number("acceleration_units_per_motor_rps2");
  w.max_speed_radps = s.number("max_speed_radps");
  w.quick_stop_radps2 = s.number("quick_stop_radps2");
  return w;
}

hw::DriveTiming read_timing(const Section& s) {
  return {.control_period = s.duration("control_period_s"),
          .command_age_limit = s.duration("command_age_limit_s"),
          .feedback_timeout = s.duration("feedback_timeout_s"),
          .rpdo_timeout = s.duration("rpdo_timeout_s"),
          .heartbeat_period = s.duration("heartbeat_period_s"),
          .heartbeat_timeout = s.duration("heartbeat_timeout_s"),
          .sdo_timeout = s.duration("sdo_timeout_s"),
          .boot_timeout = s.duration("boot_timeout_s"),
          .state_timeout = s.duration("state_timeout_s"),
          .quick_stop_timeout = s.duration("quick_stop_timeout_s"),
          .stop_margin = s.duration("stop_margin_s")};
}

}  // namespace

hw::TwoWheelDriveConfig read_drive(const Section& s, const Document& document) {
  hw::TwoWheelDriveConfig d;
  d.left = read_wheel(s.section("left"), "left wheel");
  d.right = read_wheel(s.section("right"), "right wheel");
  d.master_node = static_cast<std::uint8_t>(s.integer("master_node"));
  d.timing = read_timing(s.section("timing"));
  d.plausibility = read_plausibility(s.section("plausibility"));
  if (const auto error = hw::config_error(d)) {
    throw ConfigError(document.file, document.line_of("drive"), "drive", "", *error);
  }
  return d;
}

hw::TwoAxisHeadConfig read_head(const Section& s, const hw::TwoWheelDriveConfig& wheels, const Document& document) {
  hw::TwoAxisHeadConfig h;
  h.pan = read_head_axis(s.section("pan"), "pan");
  h.tilt = read_head_axis(s.section("tilt"), "tilt");
  h.master_node = wheels.master_node;
  h.timing = wheels.timing;
  h.plausibility = read_plausibility(s.section("plausibility"));
  h.duties = {.sync = false, .heartbeat = false};
  const auto refuse = [&document](const std::string& what) {
    throw ConfigError(document.file, document.line_of("head"), "head", "", what);
  };
  if (s.has("timing")) {
    if (wheels.left.node != 0) refuse("timing: the wheels' holds for the head too");
    h.timing = read_timing(s.section("timing"));
  }
  if (const auto error = hw::config_error(h)) refuse(*error);
  for (const std::uint8_t node : {h.pan.identity.node, h.tilt.identity.node}) {
    if (node == wheels.left.node || node == wheels.right.node)
      refuse("pan.node and tilt.node must differ from the wheels'");
  }
  return h;
}

}  // namespace hogline::config
