#include "vision/far_view/far_verdict.hpp"

#include "vision/stone_surroundings.hpp"

namespace hogline::vision {
namespace {

constexpr double least_votes = 0.42;  // whole stones have 0.55 and more
constexpr double alike = 0.25;

}  // namespace

std::string doubt_of_surroundings(const StonePicture& picture, const JudgedStone& stone,
                                  const std::vector<KnownStone>& nearer) {
  if (stone.candidate.votes < least_votes) return "too few votes for the far view";
  const StoneSurroundings around = surroundings_of(picture, stone, nearer, alike);
  if (around.granite_below) return "what should be granite goes on below the foot";
  if (around.handle_above) return "what should be a handle goes on above the grip";
  return {};
}

}  // namespace hogline::vision
