// How well a followed throw came out, against the simulator's truth.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/skip/simulated_skip.hpp"

namespace hogline {

/// Sums of squares, to be put together over throws.
struct RootMeanSquare {
  double square = 0.0;
  int count = 0;
  void add(double value) { square += value * value, ++count; }
  void add(const RootMeanSquare& other) { square += other.square, count += other.count; }
  double value() const;  ///< 0 of none
};

/// The thrown stone's place against the truth, where it was: in the house, within 2 m beyond the near hog line, within
/// 2 m before the far one.
struct RegionErrors {
  RootMeanSquare house_m;
  RootMeanSquare near_hog_m;
  RootMeanSquare far_hog_m;
  void add(double x_m, double y_m, double error_m);
  void add(const RegionErrors& other);
};

struct SkipFigures {
  RootMeanSquare aim_deg;  ///< of the stone from the far view's middle, far hog line to rest
  double worst_aim_deg = 0.0;
  double room_deg = 0.0;         ///< least of the joints to their limits; negative: hit
  std::vector<double> settle_s;  ///< after each occlusion, until it stays within 0.25 deg
  RegionErrors trajectory;       ///< as reported, up to the first collision
  RegionErrors live;             ///< as known at the moment
  std::optional<double> hog_to_hog_error_s;
  std::optional<double> spin_error_radps;  ///< of the thrown stone's rate of turn, where the handle told it
  double spin_sigma_radps = 0.0;           ///< as reported with it
  std::vector<double> rest_errors_m;       ///< of the stones that moved and lie in play
  int missed_collisions = 0;               ///< such as left the struck stone 0.15 m/s
  int invented_collisions = 0;
  int true_collisions = 0;
  int swaps = 0;        ///< stones whose end is reported for another
  int wrong_fates = 0;  ///< but those that truth decides by less than 2 cm
  std::string failed;   ///< why there is no result; else empty
};

SkipFigures figures_of(const SkipOutcome& outcome);

/// Number of each true stone by the identity in the report; -1: nobody's.
std::map<int, int> identities(const SkipOutcome& outcome);

}  // namespace hogline
