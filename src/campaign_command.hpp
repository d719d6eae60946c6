// `hogline campaign`: many throws on the simulated rink.
#pragma once

#include <cstdint>
#include <string>

#include "src/campaign/plan.hpp"

namespace hogline {

struct CampaignOptions {
  std::string rig;       ///< empty: the practice rig
  std::string scenario;  ///< empty: the practice rink
  int throws = 0;
  int jobs = 1;
  std::string seer = "oracle";
  std::uint64_t seed = 1;
  std::string speed_mps = "1.9..2.8";
  std::string heading_deg = "-1..1";
  std::string spin_radps = "1..2";
  std::string curl = "both";
  bool tee_draws = false;
  std::string without = "nothing";
  std::string faults;  ///< "all" or a part of a fault's name: faults at random moments in the place of plain throws
  int per_fault = 20;
  std::string out = "out/campaign";
};

/// Empty when `text` is a number or a range of numbers, else what is allowed: a check for the command line.
std::string number_or_range(const std::string& text);

/// What the options say, with the rig and the scenario read. Throws ConfigError.
campaign::PlanText plan_of(const CampaignOptions& options);

/// Throws what is missing, with progress on stderr, and writes the summary. Throws ConfigError for wrong use.
int run_campaign(const CampaignOptions& options);

}  // namespace hogline
