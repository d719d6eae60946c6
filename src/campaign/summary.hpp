// A campaign in one table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/campaign/row.hpp"
#include "src/campaign/statistics.hpp"

namespace hogline::campaign {

/// What a campaign measures of each throw, and how good it should be.
struct Measure {
  std::string key;   ///< of the table's column
  std::string name;  ///< for people
  std::string unit;
  std::optional<double> Row::*field = nullptr;
  std::optional<double> wanted_rms;
  std::optional<double> wanted_largest;
};
const std::vector<Measure>& measures();

/// Resting places of elite players' draws, one sigma.
inline constexpr double elite_along_sigma_m = 0.26;
inline constexpr double elite_across_sigma_m = 0.07;

struct Count {
  std::string what;
  std::vector<int> throws;  ///< their numbers
};

struct Summary {
  int throws = 0;
  int ok = 0;
  int released = 0;
  std::vector<int> violations;  ///< throws whose stone was carried into the hog line
  std::vector<int> burned;
  std::vector<Count> aborts;           ///< by reason, most frequent first; numbers in a reason are left out
  std::vector<Statistics> statistics;  ///< of each measure, over the throws that have it
  Statistics along_m;                  ///< resting places beyond the far tee; of tee draws
  Statistics across_m;                 ///< ... to the right of the centre line
  double simulated_s = 0.0;
};
/// `tee_draws`: the stones were meant to rest on the far tee.
Summary summarise(const std::vector<Row>& rows, bool tee_draws);

/// As a page: the measures' table, then what went wrong with the numbers of the throws.
std::string markdown(const Summary& summary);
std::string json(const Summary& summary);

}  // namespace hogline::campaign
