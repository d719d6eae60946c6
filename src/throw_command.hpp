// `hogline throw`: one throw on the simulated rink.
#pragma once

#include <cstdint>
#include <string>

namespace hogline {

struct ThrowOptions {
  std::string rig;       ///< empty: the practice rig
  std::string scenario;  ///< empty: the practice rink
  double speed_mps = 2.09;
  double heading_deg = 0.0;
  std::string curl = "ccw";
  double spin_radps = 1.5;
  std::uint64_t seed = 1;
  std::string out = "out/throw";
  std::string fault;  ///< KIND@SECONDS, empty for none
  std::string seer;   ///< oracle, rendered; empty: the campaign's, or rendered
  std::string from;   ///< FOLDER/throws.csv:NUMBER: a campaign's throw in the place of all that says what is thrown
  bool json_only = false;
  bool realtime = false;  ///< against the wall clock, in threads
  std::string learn;      ///< file of what releases have taught; empty: the rig file's word, nothing is kept
};

/// Empty when `text` is a fault that can be injected, else what is allowed: a check for the command line.
std::string known_fault(const std::string& text);

/// Prints progress on stderr and, as the last line on stdout, one JSON object. Throws ConfigError for wrong use.
int run_throw(const ThrowOptions& options);

}  // namespace hogline
