// `hogline campaign`: many throws on the simulated rink.
#pragma once

#include <cstdint>
#include <string>

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
  std::string out = "out/campaign";
};

/// Empty when `text` is a number or a range of numbers, else what is allowed: a check for the command line.
std::string number_or_range(const std::string& text);

/// Throws what is missing, with progress on stderr, and writes the summary. Throws ConfigError for wrong use.
int run_campaign(const CampaignOptions& options);

}  // namespace hogline
