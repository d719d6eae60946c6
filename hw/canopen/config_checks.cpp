#include "hw/canopen/config_checks.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace hogline::hw {

std::string complaint(const std::string& key, double value, const char* allowed) {
  char text[48];
  std::snprintf(text, sizeof text, "%.9g", value);
  return key + " is " + text + ", allowed: " + allowed;
}

std::optional<std::string> positive(const std::string& key, double value) {
  if (std::isfinite(value) && value > 0.0) return std::nullopt;
  return complaint(key, value, "finite and > 0");
}

std::optional<std::string> fits_32_bits(const std::string& key, double value) {
  if (value < 2147483647.0) return std::nullopt;
  return complaint(key, value, "< 2147483647 drive units");
}

std::optional<std::string> node_error(const std::string& key, std::uint8_t node) {
  if (node >= 1 && node <= 127) return std::nullopt;
  return complaint(key, node, "1..127");
}

std::optional<std::string> identity_error(const std::string& prefix, const NodeIdentity& identity) {
  if (identity.name.empty()) return prefix + "name is empty";
  if (auto error = node_error(prefix + "node", identity.node)) return error;
  if (identity.vendor_id == 0) return complaint(prefix + "vendor_id", 0.0, "the drive's 1018:01, never 0");
  if (identity.product_code == 0) return complaint(prefix + "product_code", 0.0, "the drive's 1018:02, never 0");
  return std::nullopt;
}

std::optional<std::string> gearing_error(const std::string& prefix, const AxisGearing& g, double max_speed_radps,
                                         double quick_stop_radps2) {
  if (g.direction != 1 && g.direction != -1) return complaint(prefix + "direction", g.direction, "+1 or -1");
  if (auto error = positive(prefix + "gear_ratio", g.gear_ratio)) return error;
  if (auto error = positive(prefix + "position_counts_per_motor_rev", g.position_counts_per_motor_rev)) return error;
  if (auto error = positive(prefix + "velocity_units_per_motor_rps", g.velocity_units_per_motor_rps)) return error;
  if (auto error = positive(prefix + "acceleration_units_per_motor_rps2", g.acceleration_units_per_motor_rps2)) {
    return error;
  }
  if (auto error = positive(prefix + "max_speed_radps", max_speed_radps)) return error;
  if (auto error = positive(prefix + "quick_stop_radps2", quick_stop_radps2)) return error;

  const double motor_rev_per_rad = g.gear_ratio / (2.0 * std::numbers::pi);
  const double speed_units = max_speed_radps * motor_rev_per_rad * g.velocity_units_per_motor_rps;
  const double ramp_units = quick_stop_radps2 * motor_rev_per_rad * g.acceleration_units_per_motor_rps2;
  if (auto error = fits_32_bits(prefix + "max_speed_radps in drive units", speed_units)) return error;
  if (ramp_units < 1.0) return complaint(prefix + "quick_stop_radps2 in drive units", ramp_units, ">= 1");
  return fits_32_bits(prefix + "quick_stop_radps2 in drive units", ramp_units);
}

namespace {

std::optional<std::string> whole_milliseconds(const std::string& key, Duration span, int max_ms) {
  if (span % std::chrono::milliseconds{1} == Duration{0} && span > Duration{0} &&
      span <= std::chrono::milliseconds{max_ms}) {
    return std::nullopt;
  }
  const std::string allowed = "whole milliseconds, 1.." + std::to_string(max_ms);
  return complaint("timing." + key + " [ms]", seconds(span) * 1e3, allowed.c_str());
}

std::optional<std::string> ordered(const char* shorter_key, Duration shorter, const char* longer_key, Duration longer) {
  if (shorter < longer) return std::nullopt;
  return std::string{"timing."} + shorter_key + " must be shorter than timing." + longer_key;
}

}  // namespace

std::optional<std::string> timing_error(const DriveTiming& timing) {
  if (auto error = whole_milliseconds("control_period", timing.control_period, 255)) return error;
  if (auto error = whole_milliseconds("rpdo_timeout", timing.rpdo_timeout, 65535)) return error;
  if (auto error = whole_milliseconds("heartbeat_period", timing.heartbeat_period, 65535)) return error;
  if (auto error = whole_milliseconds("heartbeat_timeout", timing.heartbeat_timeout, 65535)) return error;
  if (auto error = whole_milliseconds("sdo_timeout", timing.sdo_timeout, 10000)) return error;
  if (auto error = whole_milliseconds("boot_timeout", timing.boot_timeout, 600000)) return error;
  if (auto error = whole_milliseconds("state_timeout", timing.state_timeout, 60000)) return error;
  if (auto error = whole_milliseconds("quick_stop_timeout", timing.quick_stop_timeout, 1000)) return error;
  if (auto error = whole_milliseconds("stop_margin", timing.stop_margin, 10000)) return error;
  if (auto error = ordered("control_period", timing.control_period, "command_age_limit", timing.command_age_limit)) {
    return error;
  }
  if (auto error = ordered("control_period", timing.control_period, "feedback_timeout", timing.feedback_timeout)) {
    return error;
  }
  if (auto error = ordered("command_age_limit", timing.command_age_limit, "rpdo_timeout", timing.rpdo_timeout)) {
    return error;
  }
  return ordered("heartbeat_period", timing.heartbeat_period, "heartbeat_timeout", timing.heartbeat_timeout);
}

std::optional<std::string> plausibility_error(const DrivePlausibility& plausibility) {
  if (auto error = positive("plausibility.standstill_radps", plausibility.standstill_radps)) return error;
  if (auto error = positive("plausibility.speed_error_radps", plausibility.speed_error_radps)) return error;
  if (auto error = positive("plausibility.speed_error_time [s]", seconds(plausibility.speed_error_time))) return error;
  return positive("plausibility.position_mismatch_rad", plausibility.position_mismatch_rad);
}

}  // namespace hogline::hw
