// Boards nobody has chosen: stones alone and in clumps on a random sheet, as the skip's near camera sees them, with
// people in front and behind. Rendered by hw/sim, with exact truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/random_scene.hpp"

namespace hogline::testing {

struct BoardStone {
  double x_m = 0.0;  ///< in e
  double y_m = 0.0;
  bool red = false;          ///< else yellow
  double in_sight = 1.0;     ///< of the pixels that it would cover alone, grip and all, the share that shows it
  double handle_seen = 1.0;  ///< share of the handle's face that nothing else hides
  double rim_seen = 1.0;     ///< the same of its upper rim
  double body_seen = 1.0;    ///< the same of the body's front
};

struct RandomBoard {
  RandomScene scene;
  std::vector<BoardStone> stones;
};

struct BoardMix {
  int most_stones = 16;
  int most_in_clump = 5;  ///< touching
  int most_people = 2;
};

/// What of each stone nothing hides, stones and people of the scene. `stones` are the first of its exposure's.
void measure_visibility(const RandomScene& scene, std::vector<BoardStone>& stones);

/// The same seed and mix give the same board. Draw its picture with render(board.scene).
RandomBoard random_board(std::uint64_t seed, const BoardMix& mix = {});

}  // namespace hogline::testing
