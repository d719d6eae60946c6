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

double clearance(const StonePath& path, const std::vector<Place>& stones) {
  double least_m = std::numeric_limits<double>::infinity();
  const double whole_s = path.rest().after_s;
  for (double after_s = 0.0; !stones.empty() && after_s < whole_s + 0.05; after_s += 0.05) {
    const SlidingStone at = path.at(after_s).stone;
    for (const Place& stone : stones) {
      least_m = std::min(least_m, std::hypot(at.x_m - stone.x_m, at.y_m - stone.y_m) - 2.0 * stone_radius_m);
    }
  }
  return least_m;
}

PlaceCovariance spread(const Rest& rest, const Release& r, const ThrowerSkill& skill, const IceModel& ice) {
  const Eigen::Matrix2d by_release = rest.by_start.middleCols<2>(2) * velocity_by_release(r);
  const Eigen::Matrix<double, 2, 3> by_ice = rest.by_start.rightCols<3>();
  const Eigen::Vector2d thrower(std::pow(skill.speed_sigma_mps, 2), std::pow(skill.heading_sigma_rad, 2));
  const Eigen::Matrix2d c =
      by_release * thrower.asDiagonal() * by_release.transpose() + by_ice * ice.throw_covariance() * by_ice.transpose();
  return {c(0, 0), c(0, 1), c(1, 1)};
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
  aim.covariance = spread(rest, *release, skill, ice);
  aim.clearance_m = clearance(path, wish.stones);
  if (aim.clearance_m <= 0.0) aim.ok = false, aim.reason = "the way is not free";
  return aim;
}

double doubt_m2(const ShotAim& aim) { return aim.covariance.xx_m2 + aim.covariance.yy_m2; }

bool better(const ShotAim& a, const ShotAim& b) {
  if (a.ok != b.ok) return a.ok;
  // A hand's breadth more of clearance is worth nothing: then the surer one.
  const double enough_m = 0.3;
  const double gap_a = std::min(a.clearance_m, enough_m), gap_b = std::min(b.clearance_m, enough_m);
  return gap_a != gap_b ? gap_a > gap_b : doubt_m2(a) < doubt_m2(b);
}

std::string impossible(const ShotWish& wish, const ThrowerSkill& skill) {
  const double sum = wish.rest.x_m + wish.rest.y_m + skill.release.x_m + skill.release.y_m + skill.spin_radps;
  if (!std::isfinite(sum)) return "the wish is not finite";
  if (wish.rest.y_m < skill.release.y_m + 1.0) return "the wanted place is not down-ice of the release";
  return {};
}

}  // namespace

ShotAim aim_shot(const ShotWish& wish, const ThrowerSkill& skill, const IceModel& ice) {
  if (std::string why = impossible(wish, skill); !why.empty()) return refused(std::move(why));
  if (wish.curl) return aim_with(*wish.curl, wish, skill, ice);
  const ShotAim left = aim_with(Curl::counter_clockwise, wish, skill, ice);
  const ShotAim right = aim_with(Curl::clockwise, wish, skill, ice);
  return better(right, left) ? right : left;
}

}  // namespace hogline::servo
