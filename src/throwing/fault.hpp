// Faults that can be injected into a simulated throw.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/throwing/simulated_robot.hpp"

namespace hogline {

enum class FaultKind {
  drive_heartbeat,
  drive_dies,
  camera_freeze,
  camera_stops,
  camera_black,
  camera_saturated,
  camera_repeats,
  camera_late,
  camera_time_back,
  modbus_stop,
  modbus_stall,
  gyro_silent,
  gyro_invalid,
  can_down,
  jaws_slip,
  jaws_open
};

struct Fault {
  FaultKind kind = FaultKind::drive_heartbeat;
  double run_time_s = 0.0;  ///< after the run began
};

/// The names of all kinds, in the order of FaultKind.
const std::vector<std::string>& fault_names();

/// "KIND@SECONDS"; nothing when it is not of that form, or the kind is unknown, or the time negative or not finite.
std::optional<Fault> parse_fault(std::string_view text);

void inject(FaultKind kind, SimulatedRobot& robot);

}  // namespace hogline
