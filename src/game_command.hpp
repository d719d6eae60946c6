// `hogline game`: whole ends between two strategists, thrown by both robots on the simulated rink or by an outcome
// model in their place.
#pragma once

#include <cstdint>
#include <string>

#include "src/game_table.hpp"
#include "src/team_setup.hpp"

namespace hogline {

struct GameOptions : TableOptions {
  TeamOptions team;
  bool outcome_model = false;  ///< no robots
};

/// Prints a JSON object an event on stdout, which is DIR/game.jsonl too, and the result on stderr; DIR/game.dcl2 beside
/// it. With robots also DIR/throws.csv, summary.md and figures.json: what it was against the simulator's truth.
int run_game(const GameOptions& options);

}  // namespace hogline
