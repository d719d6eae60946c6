#include "src/skip/skip_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "servo/skip_sheet.hpp"

namespace hogline {
namespace {

constexpr double deg = 180.0 / std::numbers::pi;
constexpr double house_radius_m = 1.829 + 0.145;
constexpr double region_m = 2.0;
constexpr double aimed_deg = 0.25;
constexpr double measurable_mps = 0.15;
constexpr double called_m = 0.02;
constexpr double another_m = 0.15;

using Pair = std::pair<int, int>;

/// On the sheet, for the rules: a stone that is out is nobody's target.
bool in_play(const SkipSample& s) { return s.on_ice && !s.out && s.state == servo::SkipState::follow; }

void judge_aiming(const SkipOutcome& outcome, SkipFigures& figures) {
  for (const SkipSample& s : outcome.samples) {
    if (!in_play(s) || s.truth.y_m > servo::far_hog_line_m) continue;
    figures.aim_deg.add(s.off_axis_rad * deg);
    figures.worst_aim_deg = std::max(figures.worst_aim_deg, s.off_axis_rad * deg);
  }
  figures.room_deg = outcome.least_room_rad * deg;
  for (const auto& passer : outcome.passers) {
    const double end_s = passer.from_s + passer.for_s;
    double settled_s = 0.0;
    for (const SkipSample& s : outcome.samples) {
      if (s.t_s < end_s || s.t_s > end_s + 3.0 || !in_play(s)) continue;
      if (s.off_axis_rad * deg > aimed_deg) settled_s = s.t_s - end_s;
    }
    figures.settle_s.push_back(settled_s);
  }
}

/// Truth between the samples.
std::optional<hw::sim::StoneTruth> truth_at(const SkipOutcome& outcome, double t_s) {
  const auto& all = outcome.samples;
  const auto next = std::find_if(all.begin(), all.end(), [&](const SkipSample& s) { return s.t_s >= t_s; });
  if (next == all.end() || next == all.begin()) return std::nullopt;
  const SkipSample &a = *std::prev(next), &b = *next;
  const double u = (t_s - a.t_s) / (b.t_s - a.t_s);
  hw::sim::StoneTruth at = b.truth;
  at.x_m = a.truth.x_m + u * (b.truth.x_m - a.truth.x_m);
  at.y_m = a.truth.y_m + u * (b.truth.y_m - a.truth.y_m);
  return at;
}

void judge_tracking(const SkipOutcome& outcome, SkipFigures& figures) {
  for (const SkipSample& s : outcome.samples) {
    if (!in_play(s) || !s.known) continue;
    figures.live.add(s.truth.x_m, s.truth.y_m, std::hypot(s.known->x_m - s.truth.x_m, s.known->y_m - s.truth.y_m));
  }
  for (const servo::TrajectoryPoint& p : outcome.report.result.trajectory) {
    const auto truth = truth_at(outcome, seconds(p.stamp - *outcome.released));
    if (truth) figures.trajectory.add(truth->x_m, truth->y_m, std::hypot(p.x_m - truth->x_m, p.y_m - truth->y_m));
  }
  const auto& result = outcome.report.result;
  if (result.rotation.ok) {
    const auto truth = truth_at(outcome, seconds(result.fit.start - *outcome.released));
    const double spin = truth ? truth->spin_radps : outcome.stones.back().start.motion.spin_radps;
    figures.spin_error_radps = result.rotation.spin_radps - spin;
    figures.spin_sigma_radps = result.rotation.sigma_radps;
  }
  const auto& times = outcome.report.result.hog_to_hog_s;
  if (times && outcome.true_hog_to_hog_s) figures.hog_to_hog_error_s = times->value - *outcome.true_hog_to_hog_s;
}

void judge_collisions(const SkipOutcome& outcome, const std::map<int, int>& true_of, SkipFigures& figures) {
  std::set<Pair> happened, measurable, found;
  for (const auto& c : outcome.contacts) {
    happened.insert(std::minmax(c.striker, c.struck));
    if (c.struck_mps >= measurable_mps) measurable.insert(std::minmax(c.striker, c.struck));
  }
  for (const servo::WorldCollision& c : outcome.report.result.collisions) {
    found.insert(std::minmax(true_of.at(c.striker), true_of.at(c.struck)));
  }
  figures.true_collisions = static_cast<int>(measurable.size());
  for (const Pair& p : measurable) figures.missed_collisions += found.contains(p) ? 0 : 1;
  for (const Pair& p : found) figures.invented_collisions += happened.contains(p) ? 0 : 1;
}

void judge_ends(const SkipOutcome& outcome, const std::map<int, int>& true_of, SkipFigures& figures) {
  for (const servo::StoneOutcome& stone : outcome.report.result.stones) {
    const int i = true_of.at(stone.id);
    if (i < 0) {
      ++figures.swaps;
      continue;
    }
    const TrueStone& truth = outcome.stones[static_cast<std::size_t>(i)];
    if (stone.fate != truth.fate && truth.margin_m > called_m) ++figures.wrong_fates;
    const auto lies = [](servo::StoneFate f) {
      return f == servo::StoneFate::at_rest || f == servo::StoneFate::hogged;
    };
    if (!lies(stone.fate) || !lies(truth.fate)) continue;
    const auto miss_m = [&](const TrueStone& t) { return std::hypot(stone.x_m - t.end.x_m, stone.y_m - t.end.y_m); };
    if (stone.moved) figures.rest_errors_m.push_back(miss_m(truth));
    const bool others = std::any_of(outcome.stones.begin(), outcome.stones.end(), [&](const TrueStone& t) {
      return &t != &truth && miss_m(t) < another_m && miss_m(truth) > another_m;
    });
    figures.swaps += others ? 1 : 0;
  }
}

}  // namespace

double RootMeanSquare::value() const { return count > 0 ? std::sqrt(square / count) : 0.0; }

void RegionErrors::add(double x_m, double y_m, double error_m) {
  if (std::hypot(x_m, y_m) < house_radius_m) this->house_m.add(error_m);
  if (y_m > servo::hog_line_m && y_m < servo::hog_line_m + region_m) near_hog_m.add(error_m);
  if (y_m < servo::far_hog_line_m && y_m > servo::far_hog_line_m - region_m) far_hog_m.add(error_m);
}

void RegionErrors::add(const RegionErrors& other) {
  house_m.add(other.house_m);
  near_hog_m.add(other.near_hog_m);
  far_hog_m.add(other.far_hog_m);
}

std::map<int, int> identities(const SkipOutcome& outcome) {
  std::map<int, int> true_of;
  for (const servo::StoneOutcome& stone : outcome.report.result.stones) {
    true_of[stone.id] = -1;
    if (stone.thrown) {
      true_of[stone.id] = static_cast<int>(outcome.stones.size()) - 1;
      continue;
    }
    const StoneSighting& seen = outcome.known.standing[static_cast<std::size_t>(stone.id)];
    for (std::size_t i = 0; i < outcome.stones.size(); ++i) {
      const hw::sim::StoneTruth& s = outcome.stones[i].start.motion;
      if (std::hypot(s.x_m - seen.x_m, s.y_m - seen.y_m) < another_m) true_of[stone.id] = static_cast<int>(i);
    }
  }
  return true_of;
}

SkipFigures figures_of(const SkipOutcome& outcome) {
  SkipFigures figures;
  judge_aiming(outcome, figures);
  if (!outcome.report.ok) figures.failed = outcome.report.reason;
  if (!outcome.report.result.ok) return figures;
  const std::map<int, int> true_of = identities(outcome);
  judge_tracking(outcome, figures);
  judge_collisions(outcome, true_of, figures);
  judge_ends(outcome, true_of, figures);
  return figures;
}

}  // namespace hogline
