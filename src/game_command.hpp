// `hogline game`: whole ends between two strategists, on an outcome model in the place of the robots.
#pragma once

#include <cstdint>
#include <string>

namespace hogline {

struct GameOptions {
  int ends = 2;
  std::string first = "built-in";   ///< built-in, or dc:PORT for a Digital Curling client
  std::string second = "built-in";  ///< who has the hammer in the first end
  std::string address = "127.0.0.1";
  double thinking_s = 2280.0;       ///< each team's for the whole game
  double extra_thinking_s = 270.0;  ///< each team's for each extra end
  double connect_s = 300.0;         ///< how long clients are waited for
  std::uint64_t seed = 1;
  std::string out = "out/game";
};

/// Empty when `text` names a strategist, else what is allowed: a check for the command line.
std::string known_strategist(const std::string& text);

/// Prints a JSON object an event on stdout, which is DIR/game.jsonl too, and the result on stderr; DIR/game.dcl2 beside
/// it.
int run_game(const GameOptions& options);

}  // namespace hogline
