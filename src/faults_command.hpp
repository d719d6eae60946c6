// `hogline faults`: every fault of the table in a whole simulated throw, as a page of Markdown.
#pragma once

#include <string>

namespace hogline {

struct FaultsOptions {
  std::string out;   ///< the page's file; empty: stdout
  std::string only;  ///< cases whose group, name or way of injection contains this; empty: all
};

int run_faults(const FaultsOptions& options);

}  // namespace hogline
