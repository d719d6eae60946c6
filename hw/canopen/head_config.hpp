// What the adapter of the pan-tilt head must be told. Physical numbers have no default: an unset one is refused by
// name.
#pragma once

#include "hw/canopen/drive_config.hpp"

namespace hogline::hw {

/// One axis' drive node. Angles are those of the port (hw/head.hpp).
struct HeadAxisConfig {
  NodeIdentity identity;
  AxisGearing gearing;
  std::int32_t zero_counts = 0;        ///< 6064 where the angle is 0
  double min_rad = unset;              ///< the axis never goes beyond these: kept here and by the drive (607D)
  double max_rad = unset;              ///<
  double max_speed_radps = unset;      ///< of profile moves, and of track()
  double acceleration_radps2 = unset;  ///< of profile moves, both ways
  double quick_stop_radps2 = unset;    ///< the drive's quick-stop ramp
  double tolerance_rad = unset;        ///< a target is reached within this
};

struct TwoAxisHeadConfig {
  HeadAxisConfig pan;
  HeadAxisConfig tilt;
  std::uint8_t master_node = 0;  ///< 1..127, under which our heartbeat is sent
  DriveTiming timing;
  DrivePlausibility plausibility;
  BusDuties duties{};
};

/// Why the configuration can not be used: key, value, and what is allowed. Nothing if it can.
std::optional<std::string> config_error(const TwoAxisHeadConfig& config);

}  // namespace hogline::hw
