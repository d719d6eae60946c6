// A turn of both robots as people and programs read it: pictures, and one JSON object.
#pragma once

#include <optional>
#include <string>

#include "src/team/robots_throw.hpp"

namespace hogline {

struct ToldTurn {
  const TurnRecord* record = nullptr;
  const SimulatedTeam* team = nullptr;
  std::optional<SkipSights::Near> house_before;  ///< by vision only, as all that was seen
};

/// One JSON object on one line.
std::string turn_json(const TurnRecord& record);

/// turn.json, above.png, house.png and overview.png; by vision also what the four cameras showed. Throws
/// std::runtime_error.
void write_turn(const std::string& folder, const ToldTurn& told);

}  // namespace hogline
