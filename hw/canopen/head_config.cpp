#include "hw/canopen/head_config.hpp"

#include <algorithm>
#include <cmath>

#include "hw/canopen/axis_units.hpp"
#include "hw/canopen/config_checks.hpp"

namespace hogline::hw {
namespace {

std::optional<std::string> limits_error(const std::string& prefix, const HeadAxisConfig& axis) {
  if (!std::isfinite(axis.min_rad)) return complaint(prefix + "min_rad", axis.min_rad, "finite");
  if (!std::isfinite(axis.max_rad)) return complaint(prefix + "max_rad", axis.max_rad, "finite");
  if (axis.min_rad >= axis.max_rad) return complaint(prefix + "min_rad", axis.min_rad, "less than max_rad");
  if (axis.min_rad > 0.0 || axis.max_rad < 0.0) {
    return complaint(prefix + "min_rad", axis.min_rad, "angle 0 lies within the limits");
  }
  return std::nullopt;
}

// 607A, 607D and the tolerance, in counts.
std::optional<std::string> counts_error(const std::string& prefix, const HeadAxisConfig& axis) {
  const AxisGearing& g = axis.gearing;
  const double counts_per_rad = g.gear_ratio * g.position_counts_per_motor_rev / (2.0 * std::numbers::pi);
  const double farthest = std::max(-axis.min_rad, axis.max_rad) * counts_per_rad + std::abs(1.0 * axis.zero_counts);
  if (auto error = fits_32_bits(prefix + "limits in counts", farthest)) return error;
  const double tolerance = axis.tolerance_rad * counts_per_rad;
  if (tolerance < 1.0) return complaint(prefix + "tolerance_rad in counts", tolerance, ">= 1");
  const double ramp = axis.acceleration_radps2 * g.gear_ratio / (2.0 * std::numbers::pi);
  const double ramp_units = ramp * g.acceleration_units_per_motor_rps2;
  if (ramp_units < 1.0) return complaint(prefix + "acceleration_radps2 in drive units", ramp_units, ">= 1");
  return fits_32_bits(prefix + "acceleration_radps2 in drive units", ramp_units);
}

std::optional<std::string> axis_error(const std::string& prefix, const HeadAxisConfig& axis) {
  if (auto error = identity_error(prefix, axis.identity)) return error;
  if (auto error = gearing_error(prefix, axis.gearing, axis.max_speed_radps, axis.quick_stop_radps2)) return error;
  if (auto error = limits_error(prefix, axis)) return error;
  if (auto error = positive(prefix + "acceleration_radps2", axis.acceleration_radps2)) return error;
  if (auto error = positive(prefix + "tolerance_rad", axis.tolerance_rad)) return error;
  return counts_error(prefix, axis);
}

}  // namespace

std::optional<std::string> config_error(const TwoAxisHeadConfig& config) {
  if (auto error = axis_error("pan.", config.pan)) return error;
  if (auto error = axis_error("tilt.", config.tilt)) return error;
  if (auto error = node_error("master_node", config.master_node)) return error;
  const std::uint8_t pan = config.pan.identity.node;
  const std::uint8_t tilt = config.tilt.identity.node;
  if (pan == tilt || pan == config.master_node || tilt == config.master_node) {
    return "pan.node, tilt.node and master_node must differ";
  }
  if (auto error = timing_error(config.timing)) return error;
  return plausibility_error(config.plausibility);
}

}  // namespace hogline::hw
