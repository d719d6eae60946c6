// `hogline rink`: the simulated rink as a program of its own, in real time.
#pragma once

#include <cstdint>
#include <string>

namespace hogline {

struct RinkOptions {
  std::string rig;       ///< the thrower's
  std::string skip_rig;  ///< empty: there is no skip
  std::string scenario;  ///< empty: the practice rink
  std::uint64_t seed = 1;
  double camera_hz = 0.0;  ///< of near and low camera; 0: the scenario's
  double skip_hz = 4.0;    ///< of the skip's cameras
  std::string truth;       ///< file of what truly happens; empty: none
};

/// Runs until it is told to end (SIGTERM, SIGINT, or `quit` on stdin); `again` on stdin puts the robot back. Throws
/// ConfigError for wrong use, std::exception where a line is taken.
int run_rink(const RinkOptions& options);

}  // namespace hogline
