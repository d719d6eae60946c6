#include "servo/throw_result.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "servo/skip_sheet.hpp"
#include "servo/stone_path.hpp"

namespace hogline::servo {
namespace {

constexpr double least_push_m = 0.03;
constexpr double sigmas_that_count = 3.0;
constexpr Duration rest_that_counts = std::chrono::milliseconds(700);
constexpr Duration before_contact = std::chrono::milliseconds(20);
constexpr double longest_way_back_s = 15.0;
constexpr double least_turning_mps = 0.15;  // below it the spin's loss hangs on when exactly the stone stops

std::vector<StoneLook> looks_of(const WorldStone& stone) {
  std::vector<StoneLook> looks;
  for (auto look = stone.looks; look; look = look->before) looks.push_back(look->seen);
  std::reverse(looks.begin(), looks.end());
  return looks;
}

bool pushed(const WorldCollision& hit, const World& world) {
  const WorldStone& struck = *world.find(hit.struck);
  const double sigma = std::sqrt(struck.motion.covariance.topLeftCorner<2, 2>().trace());
  const double way = std::hypot(struck.motion.stone.x_m - hit.struck_x_m, struck.motion.stone.y_m - hit.struck_y_m);
  return way > std::max(least_push_m, sigmas_that_count * sigma);
}

/// A struck stone may stand again at once: then it has handed on to another what it got.
std::vector<WorldCollision> true_collisions(const World& world) {
  std::vector<WorldCollision> found;
  for (auto hit = world.collisions.rbegin(); hit != world.collisions.rend(); ++hit) {
    const bool handed_on =
        std::any_of(found.begin(), found.end(), [&](const auto& h) { return h.striker == hit->struck; });
    if (pushed(*hit, world) || handed_on) found.push_back(*hit);
  }
  std::reverse(found.begin(), found.end());
  return found;
}

bool hits(const WorldCollision& hit, int id) { return hit.striker == id || hit.struck == id; }

/// The thrown stone's looks up to its first collision, and not long beyond its rest.
std::vector<StoneLook> free_looks(const WorldStone& thrown, const std::vector<WorldCollision>& collisions) {
  std::vector<StoneLook> looks = looks_of(thrown);
  const auto first =
      std::find_if(collisions.begin(), collisions.end(), [&](const auto& hit) { return hits(hit, thrown.id); });
  Stamp end = Stamp::max();
  if (first != collisions.end()) end = first->stamp - before_contact;
  if (first == collisions.end() && thrown.resting_since) end = *thrown.resting_since + rest_that_counts;
  looks.erase(std::remove_if(looks.begin(), looks.end(), [&](const StoneLook& l) { return l.look.stamp > end; }),
              looks.end());
  return looks;
}

using Parameters = Eigen::Matrix<double, 7, 1>;
using Quantity = std::function<std::optional<double>(const StonePath&)>;

StonePath path_with(const ThrowFit& fit, const Parameters& by) {
  SlidingStone stone = fit.stone;
  stone.x_m += by[0], stone.y_m += by[1], stone.vx_mps += by[2], stone.vy_mps += by[3];
  IceFactors ice = fit.ice;
  ice.friction_scale += by[4], ice.curl_gain += by[5], ice.lateral_mps2 += by[6];
  return StonePath(stone, ice);
}

/// A number read off the path, with the doubt of the fit.
std::optional<Measured> measured(const ThrowFit& fit, const Quantity& quantity) {
  const auto value = quantity(path_with(fit, Parameters::Zero()));
  if (!value) return std::nullopt;
  Parameters slope = Parameters::Zero();
  for (int i = 0; i < 7; ++i) {
    const double h = 0.3 * std::sqrt(fit.covariance(i, i));
    if (h <= 0.0) continue;
    const auto more = quantity(path_with(fit, h * Parameters::Unit(i)));
    const auto less = quantity(path_with(fit, -h * Parameters::Unit(i)));
    if (!more || !less) return std::nullopt;
    slope[i] = (*more - *less) / (2.0 * h);
  }
  return Measured{*value, std::sqrt(slope.dot(fit.covariance * slope))};
}

/// When the path crosses y, before its start too: the stone may be seen only after the first hog line.
std::optional<double> crossing(const StonePath& path, double y_m) {
  if (path.start().y_m >= y_m) return path.crossing_s(y_m);
  double before = -longest_way_back_s, after = 0.0;
  if (path.at(before).stone.y_m < y_m) return std::nullopt;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (before + after);
    (path.at(middle).stone.y_m > y_m ? before : after) = middle;
  }
  return after;
}

std::optional<double> hog_to(double end_s, const StonePath& path) {
  const auto first = crossing(path, far_hog_line_m);
  return first ? std::optional(end_s - *first) : std::nullopt;
}

/// Left of the straight way on from the first hog line.
std::optional<double> curled(const StonePath& path, double end_s) {
  const auto first = crossing(path, far_hog_line_m);
  if (!first) return std::nullopt;
  const SlidingStone from = path.at(*first).stone, to = path.at(end_s).stone;
  return (from.vx_mps * (to.y_m - from.y_m) - from.vy_mps * (to.x_m - from.x_m)) / speed_mps(from);
}

void measure_times(ThrowResult& result, bool hit) {
  const ThrowFit& fit = result.fit;
  const double last_s = seconds(result.trajectory.back().stamp - fit.start);
  if (result.trajectory.back().y_m < hog_line_m) {
    result.hog_to_hog_s = measured(fit, [](const StonePath& path) -> std::optional<double> {
      const auto second = path.crossing_s(hog_line_m);
      return second ? hog_to(*second, path) : std::nullopt;
    });
  }
  const bool rests = !hit && StonePath(fit.stone, fit.ice).rest().after_s < last_s + 0.5;
  if (rests) result.hog_to_rest_s = measured(fit, [](const auto& path) { return hog_to(path.rest().after_s, path); });
  result.curl_m = measured(fit, [&](const auto& path) { return curled(path, last_s); });
}

ThrowTrack track_of(const std::vector<StoneLook>& looks, double spin_radps) {
  ThrowTrack track;
  track.spin_radps = spin_radps;
  for (const StoneLook& look : looks) track.looks.push_back(look.look);
  return track;
}

StoneRotation rotation(const std::vector<StoneLook>& looks, const ThrowFit& fit) {
  const StonePath path(fit.stone, fit.ice);
  std::vector<HandleLook> handles;
  for (const StoneLook& look : looks) {
    const double after_s = seconds(look.look.stamp - fit.start);
    const bool runs = speed_mps(path.at(after_s).stone) > least_turning_mps;
    if (look.handle_rad && runs) handles.push_back({after_s, *look.handle_rad, look.handle_sigma_rad});
  }
  return rotation_of(handles, path);
}

void fit_way(ThrowResult& result, const std::vector<StoneLook>& looks, double spin_radps, const WorldConfig& config,
             const ThrowFitConfig& fit_config) {
  ThrowTrack track = track_of(looks, spin_radps);
  ThrowTrack either_way = track;
  either_way.spin_radps = either_way_spin_radps;
  result.fit = fit_throw(either_way, curling_either_way(config.ice), fit_config);
  if (!result.fit.ok) return;
  result.rotation = rotation(looks, result.fit);
  if (result.rotation.ok) track.spin_radps = result.rotation.spin_radps;
  if (track.spin_radps == 0.0) return;
  const ThrowFit sure = fit_throw(track, config.ice, fit_config);
  if (!sure.ok) return;
  result.fit = sure;
  result.track = std::move(track);
}

std::vector<TrajectoryPoint> smoothed(const ThrowFit& fit, const std::vector<StoneLook>& looks) {
  std::vector<TrajectoryPoint> points;
  const StonePath path(fit.stone, fit.ice);
  for (const StoneLook& look : looks) {
    const Slid slid = path.at(seconds(look.look.stamp - fit.start));
    const Eigen::Matrix2d c = slid.by_start.topRows<2>() * fit.covariance * slid.by_start.topRows<2>().transpose();
    points.push_back({look.look.stamp, slid.stone.x_m, slid.stone.y_m, {c(0, 0), c(0, 1), c(1, 1)}});
  }
  return points;
}

StoneOutcome outcome_of(WorldStone stone, const std::vector<WorldCollision>& collisions, const WorldConfig& config) {
  // Nobody looks beyond the sidelines: a stone that was seen running there is out by where it must have gone.
  if (stone.phase == StonePhase::moving) judge_margins(stone, config);
  StoneOutcome out{stone.id, stone.team, stone.thrown, stone.has_moved, StoneFate::at_rest, true, 0.0, 0.0, {}};
  const MotionCovariance& c = stone.motion.covariance;
  out.x_m = stone.motion.stone.x_m, out.y_m = stone.motion.stone.y_m;
  out.covariance = {c(0, 0), c(0, 1), c(1, 1)};
  const auto doubtful = [](double margin, double sigma) { return std::abs(margin) < 2.0 * sigma; };
  out.certain = !stone.has_moved || (!doubtful(stone.side_margin_m, stone.side_sigma_m) &&
                                     !doubtful(stone.back_margin_m, stone.back_sigma_m));
  if (stone.phase == StonePhase::gone) {
    out.fate = stone.side_margin_m <= 0.0 ? StoneFate::sideline : StoneFate::through;
    return out;
  }
  if (stone.phase == StonePhase::moving && !stone.motion.at_rest()) out.fate = StoneFate::lost;
  const bool touched =
      std::any_of(collisions.begin(), collisions.end(), [&](const auto& h) { return hits(h, stone.id); });
  if (!stone.thrown || touched) return out;
  const double hog_margin = hog_line_m - stone_radius_m - out.y_m;
  if (hog_margin <= 0.0 && out.fate == StoneFate::at_rest) out.fate = StoneFate::hogged;
  out.certain = out.certain && !doubtful(hog_margin, std::sqrt(c(1, 1)));
  return out;
}

}  // namespace

ThrowResult result_of(const World& world, double spin_radps, const WorldConfig& config, const ThrowFitConfig& fit) {
  ThrowResult result;
  result.collisions = true_collisions(world);
  for (const WorldStone& stone : world.stones) result.stones.push_back(outcome_of(stone, result.collisions, config));
  const WorldStone* thrown = world.thrown();
  if (!thrown || !thrown->looks) {
    result.reason = "no stone was seen to be thrown";
    return result;
  }
  result.ok = true;
  const std::vector<StoneLook> looks = free_looks(*thrown, result.collisions);
  fit_way(result, looks, spin_radps, config, fit);
  if (!result.fit.ok) return result;
  result.trajectory = smoothed(result.fit, looks);
  const bool hit = std::any_of(result.collisions.begin(), result.collisions.end(),
                               [&](const auto& h) { return hits(h, thrown->id); });
  measure_times(result, hit);
  return result;
}

}  // namespace hogline::servo
