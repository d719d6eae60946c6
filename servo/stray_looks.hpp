// Looks that belong to no known stone, and what they may mean: the thrown stone coming into sight, a stone that was
// lost behind somebody, or one that was hit and nobody saw it. All three need several looks along one line.
#pragma once

#include "servo/stone_world.hpp"

namespace hogline::servo {

/// Finds the line of looks that ends at the newest ones, if there is one, and gives it to the stone it is of: the
/// thrown one when that is still awaited, else one that is missing. Looks that are of neither stay strays and are
/// forgotten.
void identify_strays(World& world, const WorldConfig& config);

}  // namespace hogline::servo
