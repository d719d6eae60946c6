#include "vision/stone_screening.hpp"

#include <algorithm>
#include <cmath>

#include "vision/detect/granite.hpp"

namespace hogline::vision {
namespace {

constexpr double least_granite = 0.20;  // of the body's front; a nearer stone's granite counts, too
constexpr double same_place_m = 0.2;
constexpr double close_m = 0.45;  // along the line of sight: nearer than this a fit may not be at its end
constexpr int most_rounds = 3;    // a stone behind one behind one

// A stone stands there already.
bool is_taken(const Eigen::Vector2d& place, const std::vector<JudgedStone>& stones) {
  return std::any_of(stones.begin(), stones.end(), [&place](const JudgedStone& s) {
    return s.doubt.empty() && (s.fit.place - place).norm() < same_place_m;
  });
}

}  // namespace

// Something nearer stands in the way, or beside it.
bool StoneScreening::may_be_hidden(const Eigen::Vector2d& place, const std::vector<NearerStone>& others,
                                   const Eigen::Vector2d& eye) const {
  return std::any_of(others.begin(), others.end(), [&](const NearerStone& other) {
    const double apart_m = (other.place - place).norm();
    return (other.place - eye).norm() < (place - eye).norm() && apart_m < options_.hiding_m && apart_m > same_place_m;
  });
}

std::vector<JudgedStone> StoneScreening::judge(const StonePicture& picture,
                                               const std::vector<StoneCandidate>& candidates,
                                               const std::vector<NearerStone>& nearer) {
  std::vector<JudgedStone> stones = screen(picture, candidates, nearer);
  compare_granite(stones);
  settle_close(picture, stones);
  part_overlapping(picture, stones);
  doubt_grips(stones, picture.eye(), picture.shape);
  return stones;
}

// A stone's own rows get votes, too: a fit that begins a few pixels short of it may be under way to it still, and in
// the fit of all together one would hide the other. Taken to its end by itself, it stands where the better one does.
void StoneScreening::settle_close(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  for (JudgedStone& worse : stones) {
    const bool close = std::any_of(stones.begin(), stones.end(), [&](const JudgedStone& better) {
      if (&better == &worse || !better.doubt.empty() || better.candidate.votes < worse.candidate.votes) return false;
      const Bearing bearing = bearing_of(worse.fit.place, picture.eye());
      const Eigen::Vector2d off = better.fit.place - worse.fit.place;
      return std::abs(off.dot(bearing.right)) < same_place_m && std::abs(off.dot(bearing.away)) < close_m;
    });
    if (!worse.doubt.empty() || !close) continue;
    fitter_.begin(picture, {{worse.fit.place}}, options_.close);
    worse.fit = fitter_.run().stones[0];
    worse.doubt = doubt_of(worse.candidate, worse.fit, false);
  }
}

// Each by itself: what is no stone does not look like one in any light. Then, those that something in front may hide:
// with the stones that are known by now left out of the picture.
std::vector<JudgedStone> StoneScreening::screen(const StonePicture& picture,
                                                const std::vector<StoneCandidate>& candidates,
                                                const std::vector<NearerStone>& nearer) {
  std::vector<JudgedStone> stones;
  for (const StoneCandidate& c : candidates) {
    if (is_taken(c.place, stones)) continue;
    if (granite_share(picture, c.place) < least_granite) {
      stones.push_back({c, FittedStone(), "no granite below the handle"});
      stones.back().fit.place = c.place;
      continue;
    }
    fitter_.begin(picture, {{c.place}}, options_.first);
    if (is_hopeless(fitter_.first_granite())) {
      stones.push_back({c, FittedStone(), "its colours are no stone's"});
      stones.back().fit.place = c.place;
      continue;
    }
    const FittedStone& fit = fitter_.run().stones[0];
    stones.push_back({c, fit, doubt_of(c, fit, false)});
  }
  std::vector<NearerStone> known = nearer;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty()) known.push_back({s.fit.place, s.fit.handle});
  }
  std::vector<NearerStone> newest = known;
  for (int round = 0; round < most_rounds && !newest.empty(); ++round) {
    newest = look_behind(picture, known, newest, stones);
    known.insert(known.end(), newest.begin(), newest.end());
  }
  return stones;
}

// What may be hidden by the newest of the known stones is fitted again; those that turn out to be stones are returned.
std::vector<NearerStone> StoneScreening::look_behind(const StonePicture& picture, const std::vector<NearerStone>& known,
                                                     const std::vector<NearerStone>& newest,
                                                     std::vector<JudgedStone>& stones) {
  StoneFitOptions options = options_.hidden;
  options.nearer = known;
  const Eigen::Vector2d eye = picture.eye().head<2>();
  std::vector<NearerStone> found;
  for (JudgedStone& s : stones) {
    if (s.doubt.empty() || is_taken(s.candidate.place, stones)) continue;
    if (!may_be_hidden(s.candidate.place, newest, eye)) continue;
    fitter_.begin(picture, {{s.candidate.place}}, options);
    s.fit = fitter_.run().stones[0];
    s.doubt = doubt_of(s.candidate, s.fit, true);
    if (s.doubt.empty()) found.push_back({s.fit.place, s.fit.handle});
  }
  return found;
}

// All together: stones that hide each other, and the shape they share.
void StoneScreening::refine(const StonePicture& picture, std::vector<JudgedStone>& stones,
                            const std::vector<NearerStone>& nearer) {
  const auto granite = clubs_granite(stones);
  std::vector<StoneStart> starts;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty())
      starts.push_back({s.fit.place, s.glimpsed ? granite : std::nullopt, s.before ? &*s.before : nullptr});
  }
  StoneFitOptions options = options_.all;
  options.nearer = nearer;
  fitter_.begin(picture, starts, options);
  const StoneFitResult& result = fitter_.run();
  std::size_t next = 0;
  std::vector<NearerStone> others = nearer;
  for (const FittedStone& f : result.stones) others.push_back({f.place, f.handle});
  for (JudgedStone& s : stones) {
    if (!s.doubt.empty()) continue;
    s.fit = result.stones[next++];
    const bool hidden = may_be_hidden(s.fit.place, others, picture.eye().head<2>());
    s.doubt = s.glimpsed && granite ? doubt_of_glimpse(s.candidate, s.fit, *granite, !hidden && !s.before)
                                    : doubt_of(s.candidate, s.fit, hidden);
  }
  compare_granite(stones);
  part_overlapping(picture, stones);
  doubt_grips(stones, picture.eye(), picture.shape);
}

}  // namespace hogline::vision
