#include "vision/crowd_screening.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vision/stone_looks.hpp"

namespace hogline::vision {
namespace {

constexpr double same_place_m = 0.2;
constexpr double least_handle = 0.35;  // share of the plate that has a handle's colour
constexpr int most_rounds = 3;         // a stone behind one behind one
constexpr double least_body = 0.15;    // share of a body's outline: else the votes may be a grip's
constexpr double grip_m = 0.05;        // over the plate
constexpr double rows_a_step = 2.0;
constexpr double least_step_m = 0.03;
constexpr double most_step_m = 0.10;
constexpr double drift_counts = 0.5;  // of a metre
constexpr double well_told = 0.92;
constexpr double least_promising = 0.60;  // told at best so far: else no stone is a step or two away
constexpr double another_place_m = 0.04;
constexpr double least_foreground = 0.1;  // of the columns: less is noise
constexpr double most_foreground = 0.7;

StoneFitOptions quick_look() {
  return {.iterations = 2, .fit_shape = false, .give_up_hopeless = true, .covariance = false, .pixels = 120};
}
StoneFitOptions careful_look() { return {.iterations = 3, .fit_shape = false, .covariance = false, .pixels = 200}; }

/// Where a fit may begin.
struct Start {
  Eigen::Vector2d place;
  bool always;  ///< else only where the fits before it were promising
};

// A grip, a ring's edge or a neighbour pulls votes along the line of sight farther than a fit finds back. Where a
// body's outline is missing they may be a grip's altogether, which is seen over what stands farther away.
std::vector<Start> starts_of(const StonePicture& picture, const StoneCandidate& candidate) {
  const Bearing bearing = bearing_of(candidate.place, picture.eye());
  const double per_height = bearing.range_m / (picture.eye().z() - picture.shape.handle_height_m);
  const double row_m = bearing.range_m * per_height / picture.camera.lens().intrinsics().fy_px;
  const double step_m = std::clamp(rows_a_step * row_m, least_step_m, most_step_m);
  std::vector<Start> all{{candidate.place, true}};
  if (candidate.body_votes < least_body) all.push_back({candidate.place - grip_m * per_height * bearing.away, true});
  for (const double steps : {-1.0, 1.0}) all.push_back({candidate.place + steps * step_m * bearing.away, false});
  return all;
}

bool hides_some(const Foreground& before) {
  return before.share() >= least_foreground && before.share() <= most_foreground;
}

// Of two that came to the same place the one that was there from the start is believed longer.
double worth(const JudgedStone& s) {
  const double drift_m = (s.fit.place - s.candidate.place).norm();
  return s.fit.told * s.fit.explained * (1.0 - drift_counts * std::min(1.0, drift_m));
}

// What does not look like a stone was left out of it, so that what is left tells more than it is worth.
bool is_cut_out(const JudgedStone& s) { return in_the_way_of(s.before, false) == InTheWay::what_it_is_not; }

bool is_better(const JudgedStone& a, const JudgedStone& b) {
  if (a.doubt.empty() != b.doubt.empty()) return a.doubt.empty();
  return a.fit.told * a.fit.explained > b.fit.told * b.fit.explained;
}

}  // namespace

std::vector<JudgedStone> CrowdScreening::look(const StonePicture& picture,
                                              const std::vector<StoneCandidate>& candidates) {
  return look_at_each(picture, candidates, quick_look(), fitter_);
}

void CrowdScreening::tell_apart(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  const Eigen::Vector2d eye = picture.eye().head<2>();
  for (std::size_t i = 0; i < stones.size(); ++i) {
    for (std::size_t j = i + 1; j < stones.size() && stones[i].doubt.empty(); ++j) {
      JudgedStone& a = stones[i];
      JudgedStone& b = stones[j];
      if (!b.doubt.empty() || !stand_in_one_place(a.fit.place, b.fit.place, picture)) continue;
      if ((a.candidate.place - b.candidate.place).norm() < same_place_m) continue;
      fitter_.begin(picture, {{a.candidate.place}, {b.candidate.place}}, careful_look());
      const std::vector<FittedStone>& both = fitter_.run().stones;
      if (stand_in_one_place(both[0].place, both[1].place, picture)) continue;
      const bool a_is_nearer = (both[0].place - eye).norm() < (both[1].place - eye).norm();
      if (!doubt_of(a.candidate, both[0], !a_is_nearer).empty()) continue;
      if (!doubt_of(b.candidate, both[1], a_is_nearer).empty()) continue;
      a.fit = both[0];
      b.fit = both[1];
    }
  }
}

// What is alone and in full view has shown by now that it is none, unless its fit came near to one.
std::vector<StoneCandidate> CrowdScreening::worth_another_look(const StonePicture& picture,
                                                               const std::vector<JudgedStone>& stones,
                                                               const Light& granite) const {
  const std::vector<KnownStone> known = believed(stones);
  const Eigen::Vector2d eye = picture.eye().head<2>();
  std::vector<StoneCandidate> worth_it;
  for (const JudgedStone& s : stones) {
    if (s.doubt.empty()) continue;
    const Eigen::Vector2d& place = s.candidate.place;
    const bool promising = s.fit.told >= least_promising || (!s.candidate.faint && may_be_hidden(place, known, eye)) ||
                           may_be_half_hidden(picture, place, granite);
    if (promising) worth_it.push_back(s.candidate);
  }
  return worth_it;
}

// By somebody.
bool CrowdScreening::may_be_half_hidden(const StonePicture& picture, const Eigen::Vector2d& place,
                                        const Light& granite) const {
  if (!looks_like_a_handle(picture, place)) return false;
  return hides_some(Foreground(picture, place, granite, teams_, Foreground::By::run)) ||
         hides_some(Foreground(picture, place, granite, teams_, Foreground::By::unlike));
}

void CrowdScreening::look_again(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  if (!clubs_granite(stones)) look_alone(picture, stones);
  if (const auto granite = clubs_granite(stones)) {
    glimpse_round_by_round(picture, worth_another_look(picture, stones, *granite), *granite, stones);
  }
}

void CrowdScreening::look_behind(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  if (const auto granite = clubs_granite(stones)) glimpse_round_by_round(picture, {}, *granite, stones);
}

void CrowdScreening::glimpse_round_by_round(const StonePicture& picture, const std::vector<StoneCandidate>& doubted,
                                            const Light& granite, std::vector<JudgedStone>& stones) {
  const Eigen::Vector2d eye = picture.eye().head<2>();
  std::vector<KnownStone> newest = believed(stones);
  for (int round = 0; round < most_rounds && !newest.empty(); ++round) {
    const std::size_t before = stones.size();
    std::vector<StoneCandidate> candidates = handles_.find(picture, believed(stones), newest);
    for (const StoneCandidate& c : doubted) {
      if (round == 0 || may_be_hidden(c.place, newest, eye)) candidates.push_back(c);
    }
    glimpse_all(picture, candidates, granite, stones);
    newest.clear();
    for (std::size_t i = before; i < stones.size(); ++i) {
      if (stones[i].doubt.empty()) newest.push_back({stones[i].fit.place, stones[i].fit.handle});
    }
  }
}

// Of a sheet's only stone the granite can not be known before it is found.
void CrowdScreening::look_alone(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  for (JudgedStone& s : stones) {
    if (s.fit.told < least_promising || !looks_like_a_handle(picture, s.candidate.place)) continue;
    if (is_taken(s.candidate.place, stones)) continue;
    for (const Start& start : starts_of(picture, s.candidate)) {
      fitter_.begin(picture, {{start.place}}, careful_look());
      const FittedStone& fit = fitter_.run().stones[0];
      JudgedStone moved{s.candidate, fit, doubt_of(s.candidate, fit, false)};
      moved.moved_alone = true;
      if (!moved.doubt.empty() || !has_its_grip(picture, moved, teams_)) continue;
      s = moved;
      break;
    }
  }
}

void CrowdScreening::look_at(const StonePicture& picture, const std::vector<StoneCandidate>& candidates,
                             std::vector<JudgedStone>& stones) {
  if (const auto granite = clubs_granite(stones)) glimpse_all(picture, candidates, *granite, stones);
}

// The best first: where several come out in one place, it keeps it.
void CrowdScreening::glimpse_all(const StonePicture& picture, const std::vector<StoneCandidate>& candidates,
                                 const Light& granite, std::vector<JudgedStone>& stones) {
  const std::vector<KnownStone> known = believed(stones);
  std::vector<JudgedStone> glimpsed;
  for (const StoneCandidate& c : candidates) {
    if (is_taken(c.place, stones) || !looks_like_a_handle(picture, c.place)) continue;
    glimpsed.push_back(glimpse(picture, c, known, granite));
  }
  std::sort(glimpsed.begin(), glimpsed.end(), [](const JudgedStone& a, const JudgedStone& b) {
    return is_cut_out(a) != is_cut_out(b) ? is_cut_out(b) : worth(a) > worth(b);
  });
  for (JudgedStone& s : glimpsed) {
    if (s.doubt.empty() && is_taken(s.fit.place, stones)) s.doubt = no_room;
    stones.push_back(s);
  }
}

// A fit of each by itself may have gone where a neighbour's handle or granite pulled it.
void CrowdScreening::place_again(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  const auto granite = clubs_granite(stones);
  if (!granite) return;
  for (JudgedStone& s : stones) {
    if (!s.doubt.empty() || s.fit.told > well_told) continue;
    std::vector<KnownStone> others;
    for (const JudgedStone& other : stones) {
      if (&other != &s && other.doubt.empty()) others.push_back({other.fit.place, other.fit.handle});
    }
    const JudgedStone placed = glimpse_from_starts(picture, s.candidate, others, *granite, s.before);
    const bool elsewhere = (placed.fit.place - s.fit.place).norm() > another_place_m;
    if (placed.doubt.empty() && elsewhere && is_better(placed, s)) s.fit = placed.fit;
  }
}

JudgedStone CrowdScreening::glimpse(const StonePicture& picture, const StoneCandidate& candidate,
                                    const std::vector<KnownStone>& known, const Light& granite) {
  JudgedStone best = glimpse_from_starts(picture, candidate, known, granite, {});
  if (best.doubt.empty()) return best;
  for (const Foreground::By by : {Foreground::By::run, Foreground::By::unlike}) {
    const Foreground before(picture, candidate.place, granite, teams_, by);
    if (!hides_some(before)) continue;
    const JudgedStone half = glimpse_from_starts(picture, candidate, known, granite, before);
    if (is_better(half, best)) best = half;
    if (best.doubt.empty()) break;
  }
  return best;
}

JudgedStone CrowdScreening::glimpse_from_starts(const StonePicture& picture, const StoneCandidate& candidate,
                                                const std::vector<KnownStone>& known, const Light& granite,
                                                const std::optional<Foreground>& before) {
  StoneFitOptions options = careful_look();
  options.nearer = known;
  options.give_up_hopeless = true;
  const InTheWay in_the_way = in_the_way_of(before, may_be_hidden(candidate.place, known, picture.eye().head<2>()));
  JudgedStone best;
  for (const Start& start : starts_of(picture, candidate)) {
    if (!start.always && best.fit.told < least_promising) continue;
    fitter_.begin(picture, {{start.place, granite, before ? &*before : nullptr}}, options);
    const FittedStone& fit = fitter_.run().stones[0];
    const JudgedStone seen{candidate, fit, doubt_of_glimpse(candidate, fit, granite, in_the_way), true, before};
    if (!best.glimpsed || is_better(seen, best)) best = seen;
    if (best.doubt.empty() && best.fit.told > well_told) break;
  }
  return best;
}

// Some of the plate's upper face has a hue that one of the teams could have.
bool CrowdScreening::looks_like_a_handle(const StonePicture& picture, const Eigen::Vector2d& place) const {
  const SheetCamera& camera = picture.camera;
  const StoneShape& shape = picture.shape;
  const Bearing bearing = bearing_of(place, picture.eye());
  int alike = 0;
  int tried = 0;
  for (const double part : {0.4, 0.8}) {
    for (int i = 0; i < 8; ++i) {
      const auto pixel = camera.project(circle_point(place, bearing, part * shape.handle_radius_m,
                                                     shape.handle_height_m, 0.25 * std::numbers::pi * (i + part)));
      if (!pixel || !camera.lens().in_picture(*pixel, 1.0)) continue;
      const auto white = picture.ice.at(pixel->x(), pixel->y());
      const std::uint8_t* p = picture.bgr.ptr<std::uint8_t>(static_cast<int>(std::lround(pixel->y()))) +
                              3 * static_cast<int>(std::lround(pixel->x()));
      alike += has_a_teams_hue({picture.response.linear(p[2]) / white[2], picture.response.linear(p[1]) / white[1],
                                picture.response.linear(p[0]) / white[0]},
                               teams_)
                   ? 1
                   : 0;
      ++tried;
    }
  }
  return alike >= least_handle * tried && tried > 0;
}

}  // namespace hogline::vision
