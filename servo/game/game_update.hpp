// What both teams are told after every throw.
#pragma once

#include <optional>
#include <vector>

#include "servo/game/game_state.hpp"
#include "servo/game/hack_shot.hpp"

namespace hogline::servo {

/// A stone that changed its place, or left the sheet, since the frame before.
struct StoneChange {
  Team team = Team::unknown;
  std::size_t stone = 0;
  std::optional<BoardStone> now;
};

/// How the stones ran, frame by frame.
struct Trajectory {
  double seconds_per_frame = 0.1;
  Board start;   ///< with the thrown stone where it set off
  Board finish;  ///< as the rules left them
  std::vector<std::vector<StoneChange>> frames;
};

struct LastMove {
  GameMove move;
  bool free_guard_zone_foul = false;
  std::optional<Trajectory> trajectory;
};

struct GameUpdate {
  GameState state;
  std::optional<LastMove> last;  ///< empty before the game's first move
};

}  // namespace hogline::servo
