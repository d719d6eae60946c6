// The sections of a rig file that the adapters on the CAN bus need.
#pragma once

#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/head_config.hpp"
#include "src/config/section.hpp"
#include "src/config/strict_yaml.hpp"

namespace hogline::config {

/// Section `drive`. Throws ConfigError.
hw::TwoWheelDriveConfig read_drive(const Section& s, const Document& document);

/// Section `head`. It is on the wheels' bus, with their master node and timing; they send SYNC and heartbeat. Throws
/// ConfigError.
hw::TwoAxisHeadConfig read_head(const Section& s, const hw::TwoWheelDriveConfig& wheels, const Document& document);

}  // namespace hogline::config
