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
constexpr double clear_contrast = 0.35;  // between body and surroundings: no dark paint
constexpr double least_handle_votes = 0.20;
constexpr double most_votes = 0.66;  // more than chance gives: a handle without a colour needs them
constexpr double least_handle_contrast = 0.15;
constexpr double least_explained = 0.80;
constexpr double few_votes = 0.40;
constexpr double clear_votes = 0.45;
constexpr double well_explained = 0.90;
constexpr double most_residual = 0.25;
constexpr int least_granite_pixels = 8;  // fewer say nothing of a colour
constexpr double grip_height_m = 0.045;  // of a grip's bar over the handle's rim, about
constexpr double grip_half_m = 0.06;     // across: half a bar
constexpr double grip_reach_m = 0.16;    // along: a little height is much range
constexpr double stayed_m = 0.03;
constexpr double least_lone_handle_votes = 0.50;
constexpr double least_visible = 0.15;
constexpr double most_drift_m = 0.16;
constexpr int fewest_telling = 12;          // pixels that a stone changes
constexpr int fewest_handle_told = 5;       // of those that are as foretold, on the handle
constexpr double least_handle_told = 0.08;  // of the telling ones; of a stone in full view a third
constexpr double least_told = 0.75;
constexpr double told_of_few = 0.5;        // over the root of their number: of few pixels more must be right
constexpr double least_told_alone = 0.80;  // of a stone in full view 0.91 and more
constexpr double well_told = 0.92;
constexpr double least_visible_cut_out = 0.25;
constexpr double surely_told = 0.95;
constexpr double surely_granite = 0.25;     // of the telling pixels
constexpr double least_granite_told = 0.2;  // of the telling ones, where what is no stone was left out
constexpr int many_telling = 60;
constexpr double least_told_at_last = 0.90;  // of what is alone and was doubted at first
constexpr double well_explained_glimpse = 0.90;
constexpr double least_distance_m = 0.25;  // centres of touching stones are 0.29 m apart
constexpr double most_pixel_m = 0.08;
constexpr double same_rock = 2.0;  // factor of brightness between two of a club's stones

double brightness(const Light& light) { return 0.114 * light[0] + 0.587 * light[1] + 0.299 * light[2]; }

double quality(const JudgedStone& s) { return s.candidate.votes * s.fit.explained * std::sqrt(s.fit.visible); }

}  // namespace

bool has_a_colour(const Light& handle) {
  const double spread = handle.maxCoeff() - handle.minCoeff();
  return spread >= colourless * std::max(1e-3, handle.maxCoeff()) && spread >= faint;
}

namespace {

std::string doubt_of_granite(const Light& granite) {
  const double light = brightness(granite);
  if (light < darkest_granite) return "what should be granite is black";
  if (light > lightest_granite) return "what should be granite is as light as ice";
  const double spread = granite.maxCoeff() - granite.minCoeff();
  if (spread > neutral_spread + neutral_share * light) return "what should be granite has a colour";
  return {};
}

// A handle that shows over nearer stones, its granite behind them: the handle alone must convince.
std::string doubt_of_handle_alone(const StoneCandidate& candidate, const FittedStone& fit) {
  if (brightness(fit.granite) > 1.35 * lightest_granite) return "ice, not granite, below what may be a grip";
  if (candidate.handle_votes < least_lone_handle_votes) return "neither granite nor a clear handle";
  if (!has_a_colour(fit.handle)) return "neither granite nor a handle's colour";
  return {};
}

}  // namespace

namespace {

// Dark paint beside granite leaves hardly an edge to vote, but the fit may tell both.
bool body_is_missing(const StoneCandidate& candidate, const FittedStone& fit) {
  if (candidate.body_votes >= least_body_votes || fit.body_contrast <= clear_contrast) return false;
  const bool told_all_the_same =
      fit.told > surely_told && fit.explained > surely_told && fit.granite_told > surely_granite * fit.telling;
  return !told_all_the_same;
}

}  // namespace

std::string doubt_of(const StoneCandidate& candidate, const FittedStone& fit, bool behind_another) {
  if (!fit.ok) return fit.reason;
  if (fit.visible < least_visible) return "too little of it can be seen";
  const bool handle_alone = behind_another && fit.granite_pixels < least_granite_pixels;
  const std::string doubt = handle_alone ? doubt_of_handle_alone(candidate, fit) : doubt_of_granite(fit.granite);
  if (!doubt.empty()) return doubt;
  if (!handle_alone && fit.handle_contrast < least_handle_contrast) return "no handle stands out";
  if (!has_a_colour(fit.handle) && candidate.votes < most_votes) return "a handle without colour, and few votes";
  if (candidate.handle_votes < least_handle_votes) return "hardly anything of a handle's outline";
  if (!behind_another && body_is_missing(candidate, fit)) return "a handle's outline without a body's";
  if (fit.telling > 0 && fit.told < least_told_alone) return "what is seen is not a stone's";
  if (fit.handle_told < least_handle_told * fit.telling) return "nothing of a handle";
  if (fit.explained < least_explained || fit.residual > most_residual) return "a stone does not explain the picture";
  if (candidate.votes < few_votes && fit.explained < well_explained) return "few votes, and not well explained";
  if ((fit.place - candidate.place).norm() > candidate.drift_m) return "the fit left the place of the votes";
  return {};
}

namespace {

// Where a fit stayed at its votes and nothing hides it they still say what of the outlines is there.
std::string doubt_of_votes(const StoneCandidate& candidate, const FittedStone& fit) {
  if ((fit.place - candidate.place).norm() > stayed_m) return {};
  if (candidate.handle_votes < least_handle_votes) return "hardly anything of a handle's outline";
  return body_is_missing(candidate, fit) ? "a handle's outline without a body's" : "";
}

}  // namespace

std::string doubt_of_glimpse(const StoneCandidate& candidate, const FittedStone& fit, const Light& granite,
                             InTheWay in_the_way) {
  if (!fit.ok) return fit.reason;
  if (fit.telling < fewest_telling) return "too little of it can be seen";
  const bool in_plain_sight = in_the_way == InTheWay::nothing;
  const bool cut_out = in_the_way == InTheWay::what_it_is_not;
  const double least =
      in_plain_sight || cut_out ? least_told_at_last : least_told + told_of_few / std::sqrt(fit.telling);
  if (fit.told < least || fit.explained < well_explained_glimpse) return "what can be seen of it is not a stone's";
  const std::string doubt = in_plain_sight ? doubt_of_votes(candidate, fit) : std::string();
  if (!doubt.empty()) return doubt;
  if (fit.handle_told < fewest_handle_told) return "nothing of a handle";
  if (cut_out && fit.visible < least_visible_cut_out) return "too little of it can be seen";
  if (cut_out && fit.granite_told < least_granite_told * fit.telling) return "hardly any granite";
  if (!has_a_colour(fit.handle)) return "its handle has no colour";
  if (fit.handle_contrast < faint) return "no handle stands out";
  if ((fit.granite - granite).norm() > 0.6 * granite.norm()) {
    return "its granite is not the others'";
  }
  const bool beyond_doubt = fit.told > well_told && fit.explained > well_told && fit.telling > many_telling;
  if (!beyond_doubt && (fit.place - candidate.place).norm() > most_drift_m)
    return "the fit left the place of the votes";
  return {};
}

bool is_dubious(const JudgedStone& stone) {
  const bool no_outline = stone.candidate.body_votes < least_body_votes && stone.fit.body_contrast > clear_contrast;
  const bool few = stone.candidate.votes < clear_votes;
  return stone.moved_alone || few || no_outline || in_the_way_of(stone.before, false) == InTheWay::what_it_is_not;
}

InTheWay in_the_way_of(const std::optional<Foreground>& before, bool behind_another) {
  if (before) return before->by() == Foreground::By::unlike ? InTheWay::what_it_is_not : InTheWay::others;
  return behind_another ? InTheWay::others : InTheWay::nothing;
}

std::optional<Light> clubs_granite(const std::vector<JudgedStone>& stones) {
  Light middle;
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<double> lights;
    for (const JudgedStone& s : stones) {
      if (s.doubt.empty() && s.fit.granite_pixels >= least_granite_pixels) lights.push_back(s.fit.granite[channel]);
    }
    if (lights.empty()) return std::nullopt;
    const auto at = lights.begin() + static_cast<std::ptrdiff_t>(lights.size() / 2);
    std::nth_element(lights.begin(), at, lights.end());
    middle[channel] = *at;
  }
  return middle;
}

void doubt_grips(std::vector<JudgedStone>& stones, const Eigen::Vector3d& eye, const StoneShape& shape) {
  for (JudgedStone& s : stones) {
    if (!s.doubt.empty() || s.fit.granite_pixels >= least_granite_pixels) continue;
    for (const JudgedStone& other : stones) {
      if (&other == &s || !other.doubt.empty()) continue;
      const Bearing bearing = bearing_of(other.fit.place, eye);
      const double over_m = grip_height_m * bearing.range_m / (eye.z() - shape.handle_height_m - grip_height_m);
      const Eigen::Vector2d off = s.fit.place - other.fit.place - over_m * bearing.away;
      const bool over_it =
          std::abs(off.dot(bearing.right)) < grip_half_m && std::abs(off.dot(bearing.away)) < grip_reach_m;
      if (over_it) s.doubt = "it may be a nearer stone's grip";
    }
  }
}

// Votes are good to a pixel or two, so that ice and handle mix into what is taken for granite.
bool is_hopeless(const Light& granite) {
  const double light = brightness(granite);
  return light < 0.5 * darkest_granite || light > 1.35 * lightest_granite;
}

bool stand_in_one_place(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const StonePicture& picture) {
  const Eigen::Vector3d eye = picture.eye();
  const Bearing bearing = bearing_of(0.5 * (a + b), eye);
  const double per_radian_m = bearing.range_m * bearing.range_m / (eye.z() - picture.shape.handle_height_m);
  const double pixel_m = std::min(most_pixel_m, per_radian_m / picture.camera.lens().intrinsics().fy_px);
  return std::hypot((a - b).dot(bearing.right), std::abs((a - b).dot(bearing.away)) + pixel_m) < least_distance_m;
}

void part_overlapping(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  for (std::size_t i = 0; i < stones.size(); ++i) {
    for (std::size_t j = i + 1; j < stones.size() && stones[i].doubt.empty(); ++j) {
      if (!stones[j].doubt.empty()) continue;
      if (!stand_in_one_place(stones[i].fit.place, stones[j].fit.place, picture)) continue;
      JudgedStone& worse = quality(stones[i]) < quality(stones[j]) ? stones[i] : stones[j];
      worse.doubt = no_room;
    }
  }
}

void compare_granite(std::vector<JudgedStone>& stones) {
  std::vector<double> lights;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty() && s.fit.granite_pixels >= least_granite_pixels) lights.push_back(brightness(s.fit.granite));
  }
  if (lights.size() < 3) return;
  const auto middle = lights.begin() + static_cast<std::ptrdiff_t>(lights.size() / 2);
  std::nth_element(lights.begin(), middle, lights.end());
  for (JudgedStone& s : stones) {
    if (!s.doubt.empty() || s.fit.granite_pixels < least_granite_pixels) continue;
    const double ratio = brightness(s.fit.granite) / *middle;
    if (ratio > same_rock || ratio * same_rock < 1.0) s.doubt = "its granite is not the others'";
  }
}

StoneSighting sighting_of(const JudgedStone& stone, const TeamHues& teams) {
  StoneSighting s;
  s.x_m = stone.fit.place.x();
  s.y_m = stone.fit.place.y();
  s.covariance = {stone.fit.covariance(0, 0), stone.fit.covariance(0, 1), stone.fit.covariance(1, 1)};
  s.colour = {static_cast<float>(stone.fit.handle[2]), static_cast<float>(stone.fit.handle[1]),
              static_cast<float>(stone.fit.handle[0])};
  const TeamVerdict team = team_of(s.colour, teams);
  s.team = team.team;
  s.team_confidence = team.confidence;
  s.support = stone.candidate.votes;
  s.visible = stone.fit.visible;
  s.residual = stone.fit.residual;
  return s;
}

}  // namespace hogline::vision
