// Which methods are compared, and what each is told.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/bench/footage.hpp"
#include "tests/bench/method.hpp"

namespace hogline::bench {

struct Contestant {
  std::string key;   ///< short, for ratios and options
  std::string name;  ///< in the table
  bool tracks;       ///< is started near the truth, and again after each loss
  std::function<std::unique_ptr<Method>(const Footage&)> make;
};

/// For the near camera.
std::vector<Contestant> near_contestants();

/// For the low camera of a run.
std::vector<Contestant> low_contestants();

}  // namespace hogline::bench
