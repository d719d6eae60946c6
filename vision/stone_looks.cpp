#include "vision/stone_looks.hpp"

#include <algorithm>

#include "vision/detect/granite.hpp"
#include "vision/handle_angle.hpp"

namespace hogline::vision {
namespace {

constexpr double least_granite = 0.20;  // of the body's front; a nearer stone's granite counts, too
constexpr double same_place_m = 0.2;
constexpr double least_grip = 0.65;  // of a grip in plain sight; stones in pictures of two renderers have 0.8 and more
constexpr double clear_grip = 0.85;  // paint for this very camera hardly ever has so much

JudgedStone refused(const StoneCandidate& candidate, const char* why) {
  JudgedStone stone{candidate, FittedStone(), why};
  stone.fit.place = candidate.place;
  return stone;
}

std::optional<Light> granite_of(const std::vector<JudgedStone*>& stones) {
  std::vector<JudgedStone> all;
  for (const JudgedStone* s : stones) all.push_back(*s);
  return clubs_granite(all);
}

}  // namespace

bool is_taken(const Eigen::Vector2d& place, const std::vector<JudgedStone>& stones) {
  return std::any_of(stones.begin(), stones.end(), [&place](const JudgedStone& s) {
    return s.doubt.empty() && (s.fit.place - place).norm() < same_place_m;
  });
}

bool may_be_hidden(const Eigen::Vector2d& place, const std::vector<KnownStone>& others, const Eigen::Vector2d& eye,
                   double hiding_m) {
  return std::any_of(others.begin(), others.end(), [&](const KnownStone& other) {
    const double apart_m = (other.place - place).norm();
    return (other.place - eye).norm() < (place - eye).norm() && apart_m < hiding_m && apart_m > same_place_m;
  });
}

std::vector<KnownStone> believed(const std::vector<JudgedStone>& stones) {
  std::vector<KnownStone> known;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty()) known.push_back({s.fit.place, s.fit.handle});
  }
  return known;
}

double least_grip_of(const JudgedStone& stone) { return is_dubious(stone) ? clear_grip : least_grip; }

bool has_its_grip(const StonePicture& picture, const JudgedStone& stone, const TeamHues& teams) {
  return handle_angle(picture, sighting_of(stone, teams)).present >= least_grip_of(stone);
}

std::vector<JudgedStone*> without_doubt(std::vector<JudgedStone>& stones) {
  std::vector<JudgedStone*> good;
  for (JudgedStone& s : stones) {
    if (s.doubt.empty()) good.push_back(&s);
  }
  return good;
}

std::vector<JudgedStone> look_at_each(const StonePicture& picture, const std::vector<StoneCandidate>& candidates,
                                      const StoneFitOptions& options, StoneFitter& fitter) {
  std::vector<JudgedStone> stones;
  for (const StoneCandidate& c : candidates) {
    if (is_taken(c.place, stones)) continue;
    if (c.faint) {
      stones.push_back(refused(c, "hardly anything of a stone's outlines"));
      continue;
    }
    if (granite_share(picture, c.place) < least_granite) {
      stones.push_back(refused(c, "no granite below the handle"));
      continue;
    }
    fitter.begin(picture, {{c.place}}, options);
    if (is_hopeless(fitter.first_granite())) {
      stones.push_back(refused(c, "its colours are no stone's"));
      continue;
    }
    const FittedStone& fit = fitter.run().stones[0];
    stones.push_back({c, fit, doubt_of(c, fit, false)});
  }
  return stones;
}

SharedLook fit_together(const StonePicture& picture, const StoneFitOptions& options,
                        const std::vector<JudgedStone*>& stones, StoneFitter& fitter, double hiding_m) {
  const auto granite = granite_of(stones);
  std::vector<StoneStart> starts;
  for (const JudgedStone* s : stones) {
    starts.push_back({s->fit.place, s->glimpsed ? granite : std::nullopt, s->before ? &*s->before : nullptr});
  }
  fitter.begin(picture, starts, options);
  const StoneFitResult& result = fitter.run();
  std::vector<KnownStone> others = options.nearer;
  for (const FittedStone& f : result.stones) others.push_back({f.place, f.handle});
  for (std::size_t i = 0; i < stones.size(); ++i) {
    JudgedStone& s = *stones[i];
    s.fit = result.stones[i];
    const bool behind_another = may_be_hidden(s.fit.place, others, picture.eye().head<2>(), hiding_m);
    s.doubt = s.glimpsed && granite
                  ? doubt_of_glimpse(s.candidate, s.fit, *granite, in_the_way_of(s.before, behind_another))
                  : doubt_of(s.candidate, s.fit, behind_another);
  }
  return result.look;
}

}  // namespace hogline::vision
