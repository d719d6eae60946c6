// Counts what a finder makes of random boards.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hogline::vision::testing {

/// A stone can be asked for when at least so much of it is in the picture with nothing before it, by pixels: the share
/// of those it would cover alone (body, plate and grip) that show it. From the renderer's own truth.
inline constexpr double least_in_sight = 0.5;

struct BoardScore {
  int boards = 0;
  int stones = 0;  ///< that can be asked for
  int found = 0;
  int between = 0;        ///< neither in sight nor hidden
  int between_found = 0;  ///< of these
  int hidden = 0;         ///< less than a tenth of it is in sight
  int ghosts = 0;         ///< reported where no stone is
  int wrong_team = 0;     ///< red for yellow or the other way round
  int unknown_team = 0;
  std::vector<double> errors_m;        ///< of all found
  std::vector<double> house_errors_m;  ///< of those within 2 m of the tee
  std::vector<double> in_sigmas;       ///< of all found: along and across by their covariance, over the root of two
  std::vector<std::string> failures;   ///< one line each, with the board's seed

  double recall() const { return stones > 0 ? static_cast<double>(found) / stones : 1.0; }
  double precision() const { return found + ghosts > 0 ? static_cast<double>(found) / (found + ghosts) : 1.0; }
  static double rms(const std::vector<double>& v);
};

/// Renders and searches boards `first` .. `first + count - 1` with the true pose of the camera.
BoardScore score_boards(std::uint64_t first, int count);

}  // namespace hogline::vision::testing
