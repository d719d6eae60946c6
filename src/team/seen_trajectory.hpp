// How the stones ran, for strategists and records: the thrown one as the skip saw it up to its first collision, then
// all where they came to lie.
#pragma once

#include <optional>

#include "servo/game/game_update.hpp"
#include "src/team/stone_names.hpp"

namespace hogline {

/// Nothing where the thrown stone was not seen to run. `finish` is left to the rules.
std::optional<servo::Trajectory> seen_trajectory(const SeenThrow& seen, const servo::Board& lying);

}  // namespace hogline
