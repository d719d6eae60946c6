// `hogline turn`: one turn of both robots on the simulated rink; `hogline demo`: the same, told to a person.
#pragma once

#include <string>

#include "src/team_setup.hpp"

namespace hogline {

struct TurnOptions {
  TeamOptions team;
  std::string strategist = "built-in";  ///< of the team whose turn it is: built-in, or dc:PORT
  std::string address = "127.0.0.1";
  int stones = 4;  ///< so many stones of the end have been thrown, and lie in the house or before it
  std::string out = "out/turn";
};

/// Progress on stderr, the turn as a JSON object on stdout; pictures and turn.json in the folder.
int run_turn(const TurnOptions& options);
/// A readable summary instead of JSON.
int run_demo(const TurnOptions& options);

}  // namespace hogline
