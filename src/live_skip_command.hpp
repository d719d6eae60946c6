// `hogline skip --live`: the skip as a program that stays.
#pragma once

#include <string>

#include "src/game_table.hpp"

namespace hogline {

struct LiveSkipOptions {
  std::string rig;
  std::string thrower_rig;  ///< what the thrower can: needed for a game
  TableOptions table;       ///< of the game
};

/// Runs until it is told to end (SIGTERM, SIGINT, or `quit` on stdin). Lines on stdin: `begin` looks at the house and
/// waits for a stone; `order SPEED_MPS HEADING_DEG SPIN_RADPS` orders a shot; `play` plays the table's game, or goes on
/// with it, and `stop` stops it. Throws ConfigError for wrong use.
int run_live_skip(const LiveSkipOptions& options);

}  // namespace hogline
