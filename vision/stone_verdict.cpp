#include "vision/stone_verdict.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr double darkest_granite = 0.08;  // brightness against white ice
constexpr double lightest_granite = 0.44;
constexpr double neutral_spread = 0.09;  // of the channels: noise and reflections
constexpr double neutral_share = 0.30;
constexpr double colourless = 0.35;  // share of the brightest channel that the channels of a grey differ by
constexpr double faint = 0.12;       // difference of the channels, light against white ice
constexpr double least_body_votes = 0.10;
constexpr double most_votes = 0.66;  // more than chance gives: a handle without a colour needs them
constexpr double least_handle_contrast = 0.15;
constexpr double least_explained = 0.80;
constexpr double most_residual = 0.25;
constexpr double least_visible = 0.15;
constexpr double most_drift_m = 0.16;
constexpr double least_distance_m = 0.25;  // centres of touching stones are 0.28 m apart
constexpr double same_rock = 2.0;          // factor of brightness between two of a club's stones

double brightness(const Light& light) { return 0.114 * light[0] + 0.587 * light[1] + 0.299 * light[2]; }

double quality(const JudgedStone& s) { return s.candidate.votes * s.fit.explained * std::sqrt(s.fit.visible); }

}  // namespace

std::string doubt_of(const StoneCandidate& candidate, const FittedStone& fit, bool behind_another) {
  if (!fit.ok) return fit.reason;
  if (fit.visible < least_visible) return "too little of it can be seen";
  const double light = brightness(fit.granite);
  if (light < darkest_granite) return "what should be granite is black";
  if (light > lightest_granite) return "what should be granite is as light as ice";
  const double spread = fit.granite.maxCoeff() - fit.granite.minCoeff();
  if (spread > neutral_spread + neutral_share * light) return "what should be granite has a colour";
  if (fit.handle_contrast < least_handle_contrast) return "no handle stands out";
  const double saturation = 1.0 - fit.handle.minCoeff() / std::max(1e-3, fit.handle.maxCoeff());
  const double spread_of_handle = fit.handle.maxCoeff() - fit.handle.minCoeff();
  if ((saturation < colourless || spread_of_handle < faint) && candidate.votes < most_votes)
    return "a handle without colour, and few votes";
  if (!behind_another && candidate.body_votes < least_body_votes) return "a handle's outline without a body's";
  if (fit.explained < least_explained || fit.residual > most_residual) return "a stone does not explain the picture";
  if ((fit.place - candidate.place).norm() > most_drift_m) return "the fit left the place of the votes";
  return {};
}

// Votes are good to a pixel or two, so that ice and handle mix into what is taken for granite.
bool is_hopeless(const Light& granite) {
  const double light = brightness(granite);
  return light < 0.5 * darkest_granite || light > 1.35 * lightest_granite;
}

void part_overlapping(std::vector<JudgedStone>& stones) {
  for (std::size_t i = 0; i < stones.size(); ++i) {
    for (std::size_t j = i + 1; j < stones.size() && stones[i].doubt.empty(); ++j) {
      if (!stones[j].doubt.empty() || (stones[i].fit.place - stones[j].fit.place).norm() > least_distance_m) continue;
      JudgedStone& worse = quality(stones[i]) < quality(stones[j]) ? stones[i] : stones[j];
      worse.doubt = "another stone stands there";
    }
  }
}

void compare_granite(std::vector<JudgedStone>& stones) {
  std::vector<double> lights;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty()) lights.push_back(brightness(s.fit.granite));
  }
  if (lights.size() < 3) return;
  const auto middle = lights.begin() + static_cast<std::ptrdiff_t>(lights.size() / 2);
  std::nth_element(lights.begin(), middle, lights.end());
  for (JudgedStone& s : stones) {
    const double ratio = brightness(s.fit.granite) / *middle;
    if (s.doubt.empty() && (ratio > same_rock || ratio * same_rock < 1.0)) s.doubt = "its granite is not the others'";
  }
}

}  // namespace hogline::vision
