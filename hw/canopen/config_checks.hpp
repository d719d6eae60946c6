// What the configurations of the drive adapters have in common: each check gives the complaint, or nothing.
#pragma once

#include <optional>
#include <string>

#include "hw/canopen/drive_config.hpp"

namespace hogline::hw {

/// "key is value, allowed: ...".
std::string complaint(const std::string& key, double value, const char* allowed);
std::optional<std::string> positive(const std::string& key, double value);
/// The largest number the drive is sent must fit into its 32 bits.
std::optional<std::string> fits_32_bits(const std::string& key, double value);

std::optional<std::string> node_error(const std::string& key, std::uint8_t node);
std::optional<std::string> identity_error(const std::string& prefix, const NodeIdentity& identity);
/// Scales, and that speed and ramp fit the drive's integers.
std::optional<std::string> gearing_error(const std::string& prefix, const AxisGearing& gearing, double max_speed_radps,
                                         double quick_stop_radps2);
std::optional<std::string> timing_error(const DriveTiming& timing);
std::optional<std::string> plausibility_error(const DrivePlausibility& plausibility);

}  // namespace hogline::hw
