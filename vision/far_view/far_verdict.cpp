#include "vision/far_view/far_verdict.hpp"

#include "vision/stone_surroundings.hpp"

namespace hogline::vision {
namespace {

constexpr double least_votes = 0.42;  // whole stones have 0.55 and more
constexpr double alike = 0.25;
constexpr double lightest_handle = 0.85;  // against white ice

}  // namespace

std::string doubt_of_surroundings(const StonePicture& picture, const JudgedStone& stone,
                                  const std::vector<KnownStone>& nearer) {
  if (!stone.glimpsed && stone.candidate.votes < least_votes) return "too few votes for the far view";
  const StoneSurroundings around = surroundings_of(picture, stone, nearer, alike);
  if (around.granite_below && around.handle_above) return "it goes on below the foot and above the grip";
  if (has_a_colour(stone.fit.handle)) return {};
  if (around.granite_below) return "no colour, and what should be granite goes on below the foot";
  if (around.handle_above) return "no colour, and what should be a handle goes on above the grip";
  if (stone.fit.handle.minCoeff() > lightest_handle) return "what should be a handle is as white as ice";
  return {};
}

}  // namespace hogline::vision
