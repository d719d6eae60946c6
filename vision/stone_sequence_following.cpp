// Known stones, where they must be in the next picture.
#include <algorithm>
#include <cmath>

#include "vision/stone_sequence_impl.hpp"

namespace hogline::vision {
namespace {

constexpr double same_stone_m = 0.16;  // touching ones are 0.29 m apart
constexpr double sure_px = 1.5;        // a prediction better than this needs no votes
constexpr double close_px = 0.7;       // a fit that ends farther from where it began may not be at its end
constexpr double astray_px = 3.0;      // nor may one be believed that began so far off: votes are asked
constexpr double told_less = 0.12;     // than in the last picture: it may be another's edge
constexpr double explained_less = 0.06;
constexpr double struck_mps = 2.5;  // how fast a stone may be that was struck since the last picture
constexpr double least_reach_m = 0.15;

StoneFitOptions follow_fit(const std::optional<SharedLook>& look) {
  return {.iterations = look ? 2 : 4, .pixels = 110, .nearer = {}, .begin_with = look};
}

double apart_px(const StonePicture& picture, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double z_m = picture.shape.handle_height_m;
  const auto first = picture.camera.project({a.x(), a.y(), z_m}), second = picture.camera.project({b.x(), b.y(), z_m});
  return first && second ? (*first - *second).norm() : 1e3;
}

bool is_sure(const StoneExpectation& e, const SheetCamera& camera) {
  const Eigen::Vector3d eye = camera.eMc().translation();
  const Intrinsics& k = camera.lens().intrinsics();
  const double range_m = std::hypot(e.x_m - eye.x(), e.y_m - eye.y(), eye.z());
  return std::sqrt(e.covariance.yy_m2) * k.fy_px * eye.z() / (range_m * range_m) < sure_px &&
         std::sqrt(e.covariance.xx_m2) * k.fx_px / range_m < sure_px;
}

}  // namespace

// By its own motion; a tracker knows better. What only the tracker knows of is looked for by votes.
std::vector<StoneSequence::Impl::Foretold> StoneSequence::Impl::foretell(Stamp stamp,
                                                                         const std::vector<StoneExpectation>& expected,
                                                                         const SheetCamera& camera,
                                                                         std::vector<StoneExpectation>& unknown) const {
  std::vector<Foretold> all;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double dt_s = seconds(stamp - known[i].stamp);
    const double reach_m = std::clamp(struck_mps * dt_s, least_reach_m, most_reach_m);
    all.push_back({i, known[i].seen.fit.place + dt_s * known[i].velocity, reach_m, true});
  }
  for (const StoneExpectation& e : expected) {
    const Eigen::Vector2d place(e.x_m, e.y_m);
    const auto nearest = std::min_element(all.begin(), all.end(), [&](const Foretold& a, const Foretold& b) {
      return (a.place - place).norm() < (b.place - place).norm();
    });
    if (nearest == all.end() || (nearest->place - place).norm() > same_stone_m) {
      unknown.push_back(e);
    } else if (is_sure(e, camera)) {
      nearest->place = place;
    }
  }
  return all;
}

// All of them together, for they hide each other; those that were out of sight must not hide those that were in it.
void StoneSequence::Impl::follow(const StonePicture& picture, const std::vector<Foretold>& foretold, bool in_sight,
                                 Scene& scene) {
  std::vector<JudgedStone> stones;
  std::vector<std::size_t> which;
  for (const Foretold& f : foretold) {
    if (known[f.known].in_sight != in_sight || scene.taken(f.place)) continue;
    stones.push_back(known[f.known].seen);
    stones.back().candidate.place = stones.back().fit.place = f.place;
    which.push_back(f.known);
  }
  if (stones.empty()) return;
  StoneFitOptions options = follow_fit(shared);
  options.nearer = scene.believed();
  std::vector<JudgedStone*> all;
  for (JudgedStone& s : stones) all.push_back(&s);
  fit_together(picture, options, all);
  follow_closer(picture, stones);
  for (std::size_t i = 0; i < stones.size(); ++i) {
    const FittedStone &now = stones[i].fit, &before = known[which[i]].seen.fit;
    const bool worse = now.told < before.told - told_less || now.explained < before.explained - explained_less;
    if (stones[i].doubt.empty() && !worse) scene.add(stones[i], which[i]);
  }
}

// Those that are not where they were foretold, as a stone that was just struck.
void StoneSequence::Impl::follow_closer(const StonePicture& picture, std::vector<JudgedStone>& stones) {
  StoneFitOptions options = found_fit(shared);
  std::vector<JudgedStone*> off;
  for (JudgedStone& s : stones) {
    if (!s.doubt.empty()) continue;
    const double px = apart_px(picture, s.candidate.place, s.fit.place);
    if (px > astray_px) s.doubt = "far from where it was foretold";
    if (px < close_px) options.nearer.push_back({s.fit.place, s.fit.handle});
    if (px >= close_px && px <= astray_px) off.push_back(&s);
  }
  if (off.empty()) return;
  std::vector<Eigen::Vector2d> before;
  for (const JudgedStone* s : off) before.push_back(s->fit.place);
  fit_together(picture, options, off);
  for (std::size_t i = 0; i < off.size(); ++i) {
    const bool settled = apart_px(picture, before[i], off[i]->fit.place) < close_px;
    if (off[i]->doubt.empty() && !settled) off[i]->doubt = "the fit does not come to an end";
  }
}

// Fits and judges; the handles that hide a stone are those of all others.
void StoneSequence::Impl::fit_together(const StonePicture& picture, const StoneFitOptions& options,
                                       std::vector<JudgedStone*>& stones) {
  std::vector<JudgedStone> before;
  for (const JudgedStone* s : stones) before.push_back(*s);
  const auto granite = clubs_granite(before);
  for (JudgedStone* s : stones) {
    if (s->before && granite)
      s->before.emplace(picture, s->fit.place, *granite, setup.teams, s->before->by());  // who stood there moves
  }
  const SharedLook look = vision::fit_together(picture, options, stones, fitter);
  // What is no stone, or somebody's legs before one, would tell something else of it.
  const bool all_well =
      std::all_of(stones.begin(), stones.end(), [](const JudgedStone* s) { return s->doubt.empty(); });
  if (all_well && !stones.empty()) shared = look;
}

}  // namespace hogline::vision
