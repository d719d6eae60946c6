// What becomes of a thrown stone among those that stand: all of them slid and collided to rest, without robots, buses
// or pictures. Frame s: the stone runs towards growing y.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "hw/sim/stone_motion.hpp"

namespace hogline::hw::sim {

/// Where play ends: a stone that touches a sideline or wholly passes the back line is gone at that moment.
struct PlayBounds {
  std::optional<double> sheet_width_m;  ///< between the sidelines; empty: none
  double back_line_y_m = 40.234;
};

using BoardStones = std::vector<std::optional<StoneTruth>>;

struct BoardRun {
  BoardStones stones;               ///< at rest, by their places in the vector
  bool struck = false;              ///< the thrown one touched another
  double duration_s = 0.0;          ///< until all rest
  std::vector<BoardStones> frames;  ///< every frame_s, the start left out, the end included; none when frame_s is 0
};

/// Steps of a millisecond. Precondition: stones[thrown] is there.
BoardRun run_to_rest(BoardStones stones, std::size_t thrown, const StoneScenario& scenario, const PlayBounds& bounds,
                     double frame_s = 0.0);

}  // namespace hogline::hw::sim
