// The faults of the CAN bus and of the drives on it, while the robot runs: one case each, with its deadline.
#pragma once

#include <functional>
#include <ostream>
#include <vector>

#include "tests/hw/canopen/drive_bench.hpp"

namespace hogline::hw::test {

struct CanFault {
  const char* description;
  std::function<void(DriveBench&)> inject;
  std::function<void(DriveBench&)> heal;
  Duration deadline;  ///< from injection to detection, with one control period and the bus
  DeviceErrorKind kind;
  const char* what;                         ///< part of the error's text
  enum class Left { brakes, lost } left{};  ///< lost: beyond reach, its axis is not the adapter's to stop
  double bit_rate_hz = 0.0;                 ///< of the bus; 0: frames take no time
};

void PrintTo(const CanFault& fault, std::ostream* out);

const std::vector<CanFault>& can_faults();

/// The description as a test's name.
std::string test_name(const char* description);

}  // namespace hogline::hw::test
