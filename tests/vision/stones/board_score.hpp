// Counts what a finder makes of random boards.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hogline::vision::testing {

struct BoardScore {
  int boards = 0;
  int stones = 0;  ///< that can be seen: at least half of the handle, or a third and some of the body
  int found = 0;
  int between = 0;        ///< neither in sight nor hidden
  int between_found = 0;  ///< of these
  int hidden = 0;         ///< less than 15 % of the handle's rim can be seen
  int ghosts = 0;         ///< reported where no stone is
  int wrong_team = 0;     ///< red for yellow or the other way round
  int unknown_team = 0;
  std::vector<double> errors_m;        ///< of all found
  std::vector<double> house_errors_m;  ///< of those within 2 m of the tee
  std::vector<std::string> failures;   ///< one line each, with the board's seed

  double recall() const { return stones > 0 ? static_cast<double>(found) / stones : 1.0; }
  double precision() const { return found + ghosts > 0 ? static_cast<double>(found) / (found + ghosts) : 1.0; }
  static double rms(const std::vector<double>& v);
};

/// Renders and searches boards `first` .. `first + count - 1` with the true pose of the camera.
BoardScore score_boards(std::uint64_t first, int count);

}  // namespace hogline::vision::testing
