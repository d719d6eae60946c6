// The set of throws on which the skip is measured.
#pragma once

#include <string>
#include <vector>

#include "src/skip/simulated_skip.hpp"
#include "src/skip/skip_report.hpp"

namespace hogline {

/// Empty: the program's own.
config::SkipRig load_skip_rig_or_practice(const std::string& path);
/// Throws ConfigError where the scenario has no skip.
hw::sim::Scenario load_skip_scenario(const std::string& path, std::uint64_t seed);
/// 0 leaves a camera's rate as it is.
void set_rates(hw::sim::Scenario& scenario, double far_hz, double near_hz);

/// What is told of a throw on the simulated rink; the outcome must outlive it.
ToldThrow told_of(const SkipOutcome& outcome, const SkipRequest& request);

struct SkipSet {
  config::SkipRig rig;
  std::string scenario;  ///< empty: the program's own
  std::uint64_t first_seed = 1;
  int only = 0;  ///< this many throws; 0: all 40
  SkipEyes eyes = SkipEyes::oracle;
  double far_hz = 0.0;
  double near_hz = 0.0;
  int jobs = 1;  ///< throws at a time
};

/// 40 throws: 12 draws, 6 guards, 8 hits, 6 doubles, 4 through, 4 hogged, each on an ice of its own that nobody told
/// the skip, with somebody in the line of sight for two seconds. Every second one is not announced.
SkipRequest request_of(const SkipSet& set, int number);
inline constexpr int throws_in_set = 40;

/// Writes FOLDER/throws.csv (a row a throw) and FOLDER/table.md, and prints the table; the same whatever the jobs.
/// True: nothing was missed.
bool run_set(const SkipSet& set, const std::string& folder);

}  // namespace hogline
