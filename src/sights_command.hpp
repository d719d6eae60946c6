// `hogline sights`: how well vision sees on rendered throws, as the oracle's figures.
#pragma once

#include "src/campaign_command.hpp"

namespace hogline {

/// Writes DIR/sights.csv and DIR/oracle.yaml. Throws ConfigError for wrong use.
int run_sights(const CampaignOptions& options);

}  // namespace hogline
