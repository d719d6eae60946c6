// One fault in one whole simulated throw: from power-on to the re-armed robot, and what became of it.
#pragma once

#include <cstdint>
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

/// A moment of a throw, and which throw.
struct Moment {
  std::uint64_t seed = 0;  ///< of the practice rink
  servo::ShotOrder order;
  Duration after{};  ///< of the throw's beginning
};

/// What was found when a fault struck at any moment. Nothing is expected, recovered or re-armed.
struct Struck {
  bool struck = false;           ///< false: the throw was over before
  servo::ThrowerState state{};   ///< in which the fault struck
  double room_m = 0.0;           ///< from the stone's centre to where it must be free, at that moment
  bool standing = false;         ///< the robot, in the end
  bool set_down = false;         ///< ... and the stone where it was set down in the hack
  double release_error_m = 0.0;  ///< where the jaws let go, where they did
  double release_limit_m = 0.0;  ///< the window's half
  Finding finding;
};
Struck strike_at(const Case& fault, const Moment& moment);

}  // namespace hogline::faults
