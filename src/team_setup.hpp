// Both robots as a command line asks for them.
#pragma once

#include <cstdint>
#include <string>

#include "src/team/simulated_team.hpp"

namespace hogline {

struct TeamOptions {
  std::string rig;       ///< empty: the practice rig
  std::string skip_rig;  ///< empty: the practice skip
  std::string scenario;  ///< empty: the practice rink
  std::uint64_t seed = 1;
  std::string seer = "oracle";  ///< or rendered
  double skip_hz = 0.0;         ///< of the skip's cameras; 0: 20 by the oracle, 6 in rendered pictures
};

/// Throws config::ConfigError.
TeamRequest team_request(const TeamOptions& options);

}  // namespace hogline
