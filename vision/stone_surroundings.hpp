// Whether a stone ends where stones end: a person's trousers below a jacket are granite below a handle, and so are
// shoes below trousers.
#pragma once

#include <vector>

#include "vision/stone_verdict.hpp"

namespace hogline::vision {

struct StoneSurroundings {
  bool granite_below = false;  ///< what should be granite goes on before the foot, where no nearer stone stands
  bool handle_above = false;   ///< what should be a handle goes on above where a grip ends
};

/// `nearer` are stones that may stand before it; its own place may be among them. Colours are alike that differ by less
/// than `alike` of their difference from white ice.
StoneSurroundings surroundings_of(const StonePicture& picture, const JudgedStone& stone,
                                  const std::vector<KnownStone>& nearer, double alike);

}  // namespace hogline::vision
