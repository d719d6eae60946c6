// `hogline keys`: the keys of a team, for a link that nobody else hears.
#pragma once

#include <string>
#include <vector>

namespace hogline {

struct KeysOptions {
  std::string out;
  int domain = 0;
  std::string thrower = "thrower";
  std::string skip = "skip";
  std::vector<std::string> observers;
  int days = 365;
};

/// Throws ConfigError for wrong use: a folder that holds keys, names that are none.
int run_keys(const KeysOptions& options);

}  // namespace hogline
