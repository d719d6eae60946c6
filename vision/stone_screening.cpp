#include "vision/stone_screening.hpp"

#include <algorithm>
#include <cmath>

#include "vision/stone_looks.hpp"

namespace hogline::vision {
namespace {

constexpr double same_place_m = 0.2;
constexpr double close_m = 0.45;  // along the line of sight: nearer than this a fit may not be at its end
constexpr int most_rounds = 3;    // a stone behind one behind one

}  // namespace

std::vector<JudgedStone> StoneScreening::judge(const StonePicture& picture,
                                               const std::vector<StoneCandidate>& candidates,
                                               const std::vector<KnownStone>& nearer) {
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
                                                const std::vector<KnownStone>& nearer) {
  std::vector<JudgedStone> stones = look_at_each(picture, candidates, options_.first, fitter_);
  std::vector<KnownStone> known = nearer;
  for (const KnownStone& s : believed(stones)) known.push_back(s);
  std::vector<KnownStone> newest = known;
  for (int round = 0; round < most_rounds && !newest.empty(); ++round) {
    newest = look_behind(picture, known, newest, stones);
    known.insert(known.end(), newest.begin(), newest.end());
  }
  return stones;
}

// What may be hidden by the newest of the known stones is fitted again; those that turn out to be stones are returned.
std::vector<KnownStone> StoneScreening::look_behind(const StonePicture& picture, const std::vector<KnownStone>& known,
                                                    const std::vector<KnownStone>& newest,
                                                    std::vector<JudgedStone>& stones) {
  StoneFitOptions options = options_.hidden;
  options.nearer = known;
  const Eigen::Vector2d eye = picture.eye().head<2>();
  std::vector<KnownStone> found;
  for (JudgedStone& s : stones) {
    if (s.doubt.empty() || is_taken(s.candidate.place, stones)) continue;
    if (!may_be_hidden(s.candidate.place, newest, eye, options_.hiding_m)) continue;
    fitter_.begin(picture, {{s.candidate.place}}, options);
    s.fit = fitter_.run().stones[0];
    s.doubt = doubt_of(s.candidate, s.fit, true);
    if (s.doubt.empty()) found.push_back({s.fit.place, s.fit.handle});
  }
  return found;
}

// All together: stones that hide each other, and the shape they share.
void StoneScreening::refine(const StonePicture& picture, std::vector<JudgedStone>& stones,
                            const std::vector<KnownStone>& nearer) {
  StoneFitOptions options = options_.all;
  options.nearer = nearer;
  fit_together(picture, options, without_doubt(stones), fitter_, options_.hiding_m);
  compare_granite(stones);
  part_overlapping(picture, stones);
  doubt_grips(stones, picture.eye(), picture.shape);
}

}  // namespace hogline::vision
