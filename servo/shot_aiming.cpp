#include "servo/shot_aiming.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "servo/stone_path.hpp"

namespace hogline::servo {
namespace {

constexpr double stone_radius_m = 0.145;
constexpr double close_enough_m = 1e-3;
constexpr double close_enough_mps = 1e-4;
constexpr double greatest_heading_rad = 0.3;
constexpr int most_iterations = 30;

struct Release {
  double speed_mps;
  double heading_rad;
};

SlidingStone released(const Release& r, const ThrowerSkill& skill, Curl curl) {
  const double spin = curl == Curl::counter_clockwise ? skill.spin_radps : -skill.spin_radps;
  return {skill.release.x_m, skill.release.y_m, -r.speed_mps * std::sin(r.heading_rad),
          r.speed_mps * std::cos(r.heading_rad), spin};
}

/// Of vx, vy by speed and heading.
Eigen::Matrix2d velocity_by_release(const Release& r) {
  const double c = std::cos(r.heading_rad), s = std::sin(r.heading_rad);
  return (Eigen::Matrix2d() << -s, -r.speed_mps * c, c, -r.speed_mps * s).finished();
}

/// Newton's method on where the stone rests; steps are kept within what a release can be.
std::optional<Release> solve(const ShotWish& wish, const ThrowerSkill& skill, const IceFactors& ice, Curl curl) {
  const double dx = wish.rest.x_m - skill.release.x_m, dy = wish.rest.y_m - skill.release.y_m;
  const double way_m = std::hypot(dx, dy);
  Release r{std::sqrt(2.0 * 0.085 * ice.friction_scale * way_m), std::atan2(-dx, dy)};
  for (int i = 0; i < most_iterations; ++i) {
    const Rest rest = rest_of(released(r, skill, curl), ice);
    const Eigen::Vector2d miss(wish.rest.x_m - rest.x_m, wish.rest.y_m - rest.y_m);
    if (miss.norm() < close_enough_m) return r;
    const Eigen::Matrix2d by_release = rest.by_start.middleCols<2>(2) * velocity_by_release(r);
    const Eigen::Vector2d step = by_release.inverse() * miss;
    if (!step.allFinite()) return std::nullopt;
    r.speed_mps = std::clamp(r.speed_mps + std::clamp(step[0], -0.3, 0.3), 0.1, 6.0);
    r.heading_rad = std::clamp(r.heading_rad + step[1], -greatest_heading_rad, greatest_heading_rad);
  }
  return std::nullopt;
}

double clearance(const StonePath& path, double until_s, const std::vector<Place>& stones) {
  double least_m = std::numeric_limits<double>::infinity();
  for (double after_s = 0.0; !stones.empty() && after_s < until_s + 0.05; after_s += 0.05) {
    const SlidingStone at = path.at(std::min(after_s, until_s)).stone;
    for (const Place& stone : stones) {
      least_m = std::min(least_m, std::hypot(at.x_m - stone.x_m, at.y_m - stone.y_m) - 2.0 * stone_radius_m);
    }
  }
  return least_m;
}

/// Of two numbers whose derivatives by the start and the ice are these: thrower, ice and its scatter.
Eigen::Matrix2d spread(const Eigen::Matrix<double, 2, 7>& by_start, const Release& r, const ThrowerSkill& skill,
                       const IceModel& ice) {
  const Eigen::Matrix2d by_release = by_start.middleCols<2>(2) * velocity_by_release(r);
  const Eigen::Matrix<double, 2, 3> by_ice = by_start.rightCols<3>();
  const Eigen::Vector2d thrower(std::pow(skill.speed_sigma_mps, 2), std::pow(skill.heading_sigma_rad, 2));
  return by_release * thrower.asDiagonal() * by_release.transpose() +
         by_ice * ice.throw_covariance() * by_ice.transpose();
}

ShotAim refused(std::string reason) {
  ShotAim aim;
  aim.reason = std::move(reason);
  return aim;
}

ShotAim aim_with(Curl curl, const ShotWish& wish, const ThrowerSkill& skill, const IceModel& ice) {
  const IceFactors factors = ice.estimate().factors();
  const auto release = solve(wish, skill, factors, curl);
  if (!release) return refused("no release brings a stone there");
  if (release->speed_mps > skill.max_speed_mps) return refused("the thrower is not fast enough");
  const StonePath path(released(*release, skill, curl), factors);
  const Rest rest = path.rest();
  ShotAim aim;
  aim.ok = true;
  aim.order = {release->speed_mps, release->heading_rad, curl, skill.spin_radps};
  aim.rest = {rest.x_m, rest.y_m};
  const Eigen::Matrix2d c = spread(rest.by_start, *release, skill, ice);
  aim.covariance = {c(0, 0), c(0, 1), c(1, 1)};
  aim.clearance_m = clearance(path, rest.after_s, wish.stones);
  if (aim.clearance_m <= 0.0) aim.ok = false, aim.reason = "the way is not free";
  return aim;
}

double doubt_m2(const ShotAim& aim) { return aim.covariance.xx_m2 + aim.covariance.yy_m2; }

// More clearance than a hand's breadth is worth nothing: then the surer one.
bool better(bool ok_a, double gap_a, double doubt_a, bool ok_b, double gap_b, double doubt_b) {
  const double enough_m = 0.3;
  if (ok_a != ok_b) return ok_a;
  const double a = std::min(gap_a, enough_m), b = std::min(gap_b, enough_m);
  return a != b ? a > b : doubt_a < doubt_b;
}

std::string impossible(const Place& wish, const ThrowerSkill& skill) {
  const double sum = wish.x_m + wish.y_m + skill.release.x_m + skill.release.y_m + skill.spin_radps;
  if (!std::isfinite(sum)) return "the wish is not finite";
  if (wish.y_m < skill.release.y_m + 1.0) return "the wanted place is not down-ice of the release";
  return {};
}

/// The stone where its path crosses the contact's y, with derivatives of x there and of the speed there by the seven of
/// the start: a change at the moment, and one of the moment.
struct Passage {
  double x_m = 0.0;
  double speed_mps = 0.0;
  double heading_rad = 0.0;
  double after_s = 0.0;
  Eigen::Matrix<double, 2, 7> by_start = Eigen::Matrix<double, 2, 7>::Zero();
};

std::optional<Passage> passage(const StonePath& path, double y_m) {
  const auto after_s = path.crossing_s(y_m);
  if (!after_s) return std::nullopt;
  const Slid slid = path.at(*after_s);
  const SlidingStone& at = slid.stone;
  const double speed = speed_mps(at);
  if (speed <= 0.0 || at.vy_mps <= 0.0) return std::nullopt;
  const Eigen::RowVector2d along(at.vx_mps / speed, at.vy_mps / speed);
  const Eigen::Matrix<double, 1, 7> later = -slid.by_start.row(1) / at.vy_mps;
  Passage p{at.x_m, speed, std::atan2(-at.vx_mps, at.vy_mps), *after_s, {}};
  p.by_start.row(0) = slid.by_start.row(0) + at.vx_mps * later;
  p.by_start.row(1) = along * slid.by_start.bottomRows<2>() - deceleration_mps2(speed, path.ice()) * later;
  return p;
}

/// Newton's method on the place and on the square of the speed at the contact, which is nearly linear in the release. A
/// step that would stop short of the contact is halved.
std::optional<Release> solve(const HitWish& wish, const ThrowerSkill& skill, const IceFactors& ice, Curl curl) {
  const double dx = wish.contact.x_m - skill.release.x_m, dy = wish.contact.y_m - skill.release.y_m;
  Release r{std::sqrt(wish.speed_mps * wish.speed_mps + 0.25 * ice.friction_scale * dy), std::atan2(-dx, dy)};
  Release reached = r;
  for (int i = 0; i < most_iterations; ++i) {
    const auto p = passage(StonePath(released(r, skill, curl), ice), wish.contact.y_m);
    if (!p) {
      r = {0.5 * (r.speed_mps + reached.speed_mps), 0.5 * (r.heading_rad + reached.heading_rad)};
      continue;
    }
    reached = r;
    const double square = wish.speed_mps * wish.speed_mps - p->speed_mps * p->speed_mps;
    const Eigen::Vector2d miss(wish.contact.x_m - p->x_m, square / (2.0 * p->speed_mps));
    if (std::abs(miss[0]) < close_enough_m && std::abs(miss[1]) < close_enough_mps) return r;
    const Eigen::Matrix2d by_release = p->by_start.middleCols<2>(2) * velocity_by_release(r);
    const Eigen::Vector2d step = by_release.inverse() * miss;
    if (!step.allFinite()) return std::nullopt;
    r.speed_mps = std::clamp(r.speed_mps + std::clamp(step[0], -0.3, 0.3), 0.1, 6.0);
    r.heading_rad = std::clamp(r.heading_rad + step[1], -greatest_heading_rad, greatest_heading_rad);
  }
  return std::nullopt;
}

HitAim no_hit(std::string reason) {
  HitAim aim;
  aim.reason = std::move(reason);
  return aim;
}

HitAim hit_with(Curl curl, const HitWish& wish, const ThrowerSkill& skill, const IceModel& ice) {
  const IceFactors factors = ice.estimate().factors();
  const auto release = solve(wish, skill, factors, curl);
  if (!release) return no_hit("no release brings a stone there");
  if (release->speed_mps > skill.max_speed_mps) return no_hit("the thrower is not fast enough");
  const StonePath path(released(*release, skill, curl), factors);
  const Passage p = *passage(path, wish.contact.y_m);
  const Eigen::Matrix2d c = spread(p.by_start, *release, skill, ice);
  HitAim aim{true, {}, {}, p.speed_mps, p.heading_rad, std::sqrt(c(0, 0)), std::sqrt(c(1, 1)), 0.0};
  aim.order = {release->speed_mps, release->heading_rad, curl, skill.spin_radps};
  aim.clearance_m = clearance(path, p.after_s, wish.stones);
  if (aim.clearance_m <= 0.0) aim.ok = false, aim.reason = "the way is not free";
  return aim;
}

}  // namespace

ShotAim aim_shot(const ShotWish& wish, const ThrowerSkill& skill, const IceModel& ice) {
  if (std::string why = impossible(wish.rest, skill); !why.empty()) return refused(std::move(why));
  if (wish.curl) return aim_with(*wish.curl, wish, skill, ice);
  const ShotAim left = aim_with(Curl::counter_clockwise, wish, skill, ice);
  const ShotAim right = aim_with(Curl::clockwise, wish, skill, ice);
  const bool rather_right =
      better(right.ok, right.clearance_m, doubt_m2(right), left.ok, left.clearance_m, doubt_m2(left));
  return rather_right ? right : left;
}

HitAim aim_hit(const HitWish& wish, const ThrowerSkill& skill, const IceModel& ice) {
  if (std::string why = impossible(wish.contact, skill); !why.empty()) return no_hit(std::move(why));
  if (!(wish.speed_mps > 0.05) || !std::isfinite(wish.speed_mps)) return no_hit("the wanted speed is none of a hit");
  if (wish.curl) return hit_with(*wish.curl, wish, skill, ice);
  const HitAim left = hit_with(Curl::counter_clockwise, wish, skill, ice);
  const HitAim right = hit_with(Curl::clockwise, wish, skill, ice);
  const bool rather_right =
      better(right.ok, right.clearance_m, right.aside_sigma_m, left.ok, left.clearance_m, left.aside_sigma_m);
  return rather_right ? right : left;
}

}  // namespace hogline::servo
