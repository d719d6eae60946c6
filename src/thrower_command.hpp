// `hogline thrower`: the thrower as a program that stays. `hogline hold`: the operator's hand on its switch.
#pragma once

#include <string>

namespace hogline {

struct ThrowerOptions {
  std::string rig;
};

/// Runs until it is told to end (SIGTERM, SIGINT). Throws ConfigError for wrong use, std::exception where a line can
/// not be opened.
int run_thrower(const ThrowerOptions& options);

struct HoldOptions {
  std::string rig;
  double seconds = 0.0;  ///< 0: until it is told to end
};

/// Presses the switch and holds it.
int run_hold(const HoldOptions& options);

}  // namespace hogline
