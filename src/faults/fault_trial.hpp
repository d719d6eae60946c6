// One fault in one whole simulated throw: from power-on to the re-armed robot, and what became of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/faults/fault_case.hpp"

namespace hogline::faults {

/// What was measured. Times are simulated.
struct Finding {
  std::optional<double> detected_after_s;  ///< injection to abort; empty: never
  std::optional<double> stopped_after_s;   ///< injection (of the first fault, where there are two) to standstill
  double stop_distance_m = 0.0;            ///< the way of the body from then
  bool braked = false;                     ///< ... which is no longer than a quick stop needs
  double speed_mps = 0.0;                  ///< when it was injected
  bool held = false;                       ///< the stone is still in the jaws
  bool over_the_line = false;              ///< ... and was carried into the hog line
  bool moved_on_recovery = false;          ///< anything: body, arm, jaws; with the fault gone, nobody having re-armed
  bool moved_on_rearming = false;
  bool ready_again = false;  ///< after re-arming, all devices are without error
  std::string log;           ///< the reason, as logged
  ThrowResult result;
  std::vector<std::string> failures;  ///< what is not as the case expects
};

/// The same case gives the same finding.
Finding try_fault(const Case& fault);

}  // namespace hogline::faults
