// The outcome of a throw against the simulator's truth.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hw/sim/truth.hpp"
#include "servo/thrower.hpp"
#include "src/throwing/latency_record.hpp"

namespace hogline {

/// Errors are "what it was" less "what it should have been".
struct ReleaseOutcome {
  double hog_distance_m = 0.0;  ///< of b's origin when the stone was free
  double target_hog_distance_m = 0.0;
  double speed_error_mps = 0.0;
  double heading_error_rad = 0.0;  ///< counter-clockwise positive
  double lateral_error_m = 0.0;    ///< of the stone from the shot's line, left positive
  double spin_error_radps = 0.0;   ///< in the ordered sense positive
};

struct StateTime {
  std::string name;
  double t_s = 0.0;
};

struct ThrowResult {
  bool ok = false;                        ///< let go inside the window, no violation, no touch, no abort
  std::optional<ReleaseOutcome> release;  ///< empty when the stone was kept
  bool hog_line_violation = false;        ///< the stone's centre was less than a radius before the line while held
  bool stone_burned = false;              ///< the robot touched the stone after letting it go
  std::optional<double> yaw_after_alignment_rad;  ///< true heading less the ordered one, when the alignment ended
  std::vector<StateTime> states;
  std::optional<std::string> abort;
  std::vector<std::string> device_errors;    ///< what each device said of itself, in the order of its coming
  double stop_hog_distance_m = 0.0;          ///< where the robot came to rest
  std::optional<hw::sim::StoneTruth> rest;   ///< where the released stone came to rest, in e
  std::optional<double> measured_delay_s;    ///< from the order to the stone being free, by the jaws' own report
  std::vector<double> rehearsed_delays_s;    ///< of the trials in the hack
  std::optional<double> believed_delay_s;    ///< with which the release was timed
  std::optional<double> freed_at_speed_mps;  ///< of the body, as believed then
  std::optional<bool> fault_struck;          ///< of the injected fault; false: the run was over before
  std::optional<RealtimeFigures> realtime;   ///< of a throw against the wall clock
  double sim_time_s = 0.0;
  double wall_time_s = 0.0;
};

/// The result as one JSON object on one line, keys in a fixed order.
std::string result_line(const ThrowResult& result);

}  // namespace hogline
