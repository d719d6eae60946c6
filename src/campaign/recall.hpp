// One throw of a campaign once more.
#pragma once

#include <string>

#include "src/campaign/plan.hpp"
#include "src/campaign/row.hpp"

namespace hogline::campaign {

struct Recalled {
  ThrowRequest request;
  Draw draw;
  Row row;  ///< as it stands in the table
};

/// `words`: FOLDER/throws.csv:NUMBER, or FOLDER:NUMBER. Throws ConfigError when there is no such throw.
Recalled recall(const std::string& words);

}  // namespace hogline::campaign
