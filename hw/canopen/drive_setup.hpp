// Everything that is written into a drive before it is started.
#pragma once

#include <vector>

#include "hw/canopen/drive_config.hpp"
#include "hw/canopen/head_config.hpp"
#include "hw/canopen/sdo.hpp"

namespace hogline::hw {

// In order: watchdogs and stop reactions first, so that a node that gets no further is already safe; then mode, limits
// and interpolation time; then the PDOs. For a node in pre-operational. doc/bus_maps.md lists the objects and why.
std::vector<SdoWrite> wheel_setup(const WheelConfig& wheel, const DriveTiming& timing, std::uint8_t master_node);
std::vector<SdoWrite> head_axis_setup(const HeadAxisConfig& axis, const DriveTiming& timing, std::uint8_t master_node);

/// A value that must be found again where it was written.
struct SdoExpectation {
  ObjectAddress address;
  std::uint32_t value = 0;
  std::uint32_t mask = 0xFFFFFFFF;  ///< the bits that must agree
  bool optional = false;
};

/// What a drive that took all these writes holds: the last write of each object. A COB-ID's bits 29 and 30 are the
/// device's own.
std::vector<SdoExpectation> expected_after(const std::vector<SdoWrite>& writes);

}  // namespace hogline::hw
