// Views down the sheet nobody has chosen: the far camera on a skip's head, turned to where a stone runs, on a sheet of
// any of the clubs' colours and dividers, with other stones here and next door, people and logos. Rendered by hw/sim,
// with exact truth.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/random_board.hpp"
#include "tests/support/random_scene.hpp"

namespace hogline::testing {

struct FarMix {
  int most_stones = 1;  ///< on our sheet; one at least where `least_stones` says so
  int least_stones = 1;
  int most_people = 2;      ///< anywhere but before the first stone
  int most_neighbours = 3;  ///< stones of the next sheets
  int most_logos = 2;
  double most_tilt_rad = 0.0087;  ///< by which head and mount are off: 0.5 deg
  double most_pan_rad = 0.0;
};

struct FarScene {
  RandomScene scene;  ///< `scene.eMc` is the true pose
  vision::Pose planned;
  std::vector<BoardStone> stones;  ///< of our sheet, in view; the head looks at the first
};

/// The same seed and mix give the same scene. Draw its picture with render(scene.scene).
FarScene random_far_scene(std::uint64_t seed, const FarMix& mix = {});

}  // namespace hogline::testing
