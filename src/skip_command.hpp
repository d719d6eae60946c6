// `hogline skip`: one throw on the simulated rink, seen by the skip behind the far house.
#pragma once

#include <cstdint>
#include <string>

namespace hogline {

struct SkipOptions {
  std::string rig;       ///< empty: the practice skip
  std::string scenario;  ///< empty: the practice rink
  std::string kind = "draw";
  int number = -1;  ///< of the set's throws, instead of kind and ice; -1: none
  std::uint64_t seed = 1;
  bool oracle = false;
  bool unannounced = false;
  double far_hz = 0.0;  ///< 0: the scenario's
  double near_hz = 0.0;
  std::string ice;     ///< file, read if it is there and written afterwards; empty: none
  std::string record;  ///< folder for the pictures; empty: none are kept
  std::string out = "out/skip";
  bool json_only = false;
};

/// Throws ConfigError for wrong use.
int run_skip(const SkipOptions& options);

/// Up to a whole set.
struct SkipsOptions {
  std::string rig;
  std::string scenario;
  std::uint64_t seed = 1;
  int only = 0;  ///< this many of the set's throws; 0: all
  int jobs = 1;  ///< throws at a time
  bool oracle = false;
  double far_hz = 0.0;
  double near_hz = 0.0;
  std::string out = "out/skips";
};

/// The set of 40 throws, with a table of what was reached.
int run_skips(const SkipsOptions& options);

}  // namespace hogline
