// What only the long lens must ask: whether a stone ends where stones end. Seen from 4 to 12 degrees above the ice, a
// person's trousers below a jacket are granite below a handle, and so are shoes below trousers.
#pragma once

#include <string>

#include "vision/stone_verdict.hpp"

namespace hogline::vision {

/// Why something is no stone by what is seen before its foot and over its grip; empty where there is no doubt. Paint of
/// granite's grey before a stone is no reason by itself, nor is somebody behind it in its handle's colour: a person has
/// both. A handle without a colour, which many things have, is refused for either, and where it is ice.
std::string doubt_of_surroundings(const StonePicture& picture, const JudgedStone& stone,
                                  const std::vector<KnownStone>& nearer);

}  // namespace hogline::vision
