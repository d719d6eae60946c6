// What only the long lens must ask: whether a stone ends where stones end. Seen from 4 to 12 degrees above the ice, a
// person's trousers below a jacket are granite below a handle, and so are shoes below trousers.
#pragma once

#include <string>

#include "vision/stone_verdict.hpp"

namespace hogline::vision {

/// Why something is no stone by what is seen before its foot and over its grip; empty where there is no doubt.
std::string doubt_of_surroundings(const StonePicture& picture, const JudgedStone& stone,
                                  const std::vector<KnownStone>& nearer);

}  // namespace hogline::vision
