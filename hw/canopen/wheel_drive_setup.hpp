// Everything that is written into a wheel drive before it is started.
#pragma once

#include <vector>

#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/sdo.hpp"

namespace hogline::hw {

/// In order: watchdogs and stop reactions first, so that a node that gets no further is already safe; then mode and
/// interpolation time; then the PDOs. For a node in pre-operational. doc/bus_maps.md lists the objects and why.
std::vector<SdoWrite> wheel_drive_setup(const WheelConfig& wheel, const DriveTiming& timing, std::uint8_t master_node);

}  // namespace hogline::hw
