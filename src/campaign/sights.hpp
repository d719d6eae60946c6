// How well vision sees on rendered throws, measured against the truth: what the oracle is made of.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/campaign/plan.hpp"
#include "src/throwing/oracle_quality.hpp"

namespace hogline::campaign {

/// One look.
struct Sighting {
  int throw_number = 0;
  bool low = false;
  double t_s = 0.0;    ///< of the frame
  double hog_m = 0.0;  ///< true distance
  bool ok = false;
  PlanarPose error;     ///< measured less true, when ok
  PlanarSigma claimed;  ///< when ok
};

/// Throws the plan's first `throws` throws with vision at rendered pictures and notes every look, in the order of
/// throws and frames. `tick` is called after each throw.
std::vector<Sighting> watch_throws(const Plan& plan, int throws, int jobs, const std::function<void()>& tick);

/// Splits the errors by distance and by how long they last: an offset common to all throws, a bias constant in a throw,
/// a drift with a correlation time (from the autocovariance at one and two frames), noise. A distance that is not
/// measured (claimed sigma above a metre) has no errors. Precondition: each camera saw something.
OracleQuality fit_oracle(const std::vector<Sighting>& sightings);

/// As a table: a line a look.
std::string sightings_csv(const std::vector<Sighting>& sightings);

}  // namespace hogline::campaign
