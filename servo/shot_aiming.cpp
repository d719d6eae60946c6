#include "servo/shot_aiming.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "servo/stone_path.hpp"

namespace hogline::servo {
namespace {

constexpr double stone_radius_m = 0.145;
constexpr double close_enough_m = 1e-3;
constexpr double close_enough_aside_m = 1e-4;  // a thin hit turns a millimetre into many
constexpr double close_enough_mps = 1e-4;
constexpr double greatest_heading_rad = 0.3;
constexpr int most_iterations = 30;

using ByStart = Eigen::Matrix<double, 2, 7>;

struct Release {
  double speed_mps;
  double heading_rad;
};

ShotOrder order_of(const Release& r, Curl curl, const ThrowerSkill& skill) {
  return {r.speed_mps, r.heading_rad, curl, skill.spin_radps};
}

/// Of vx, vy by speed and heading.
Eigen::Matrix2d velocity_by_release(const Release& r) {
  const double c = std::cos(r.heading_rad), s = std::sin(r.heading_rad);
  return (Eigen::Matrix2d() << -s, -r.speed_mps * c, c, -r.speed_mps * s).finished();
}

/// What a way still lacks of a wish: two numbers, with their derivatives by the way's start and the ice.
struct Lack {
  Eigen::Vector2d miss;
  bool close = false;
  ByStart by_start;
};

/// What both kinds of wish have in common: where they lead to, and with which speed a straight way would get there.
struct Course {
  Place to;
  double first_speed_mps;
};

/// Of what depends on the start, by speed and heading: the velocity, and the place on the line where it is let go.
Eigen::Matrix2d by_speed_and_heading(const ByStart& by_start, const Release& r, const ThrowerSkill& skill) {
  Eigen::Matrix2d by = by_start.middleCols<2>(2) * velocity_by_release(r);
  const double c = std::cos(r.heading_rad);
  if (skill.line_through_hack) by.col(1) -= skill.release.y_m / (c * c) * by_start.col(0);
  return by;
}

/// Newton's method on speed and heading; steps are kept within what a release can be. `lack_of` says nothing of a way
/// that stops before its end: that step is halved.
template <class LackOf>
std::optional<Release> solve(const Course& course, Curl curl, const ThrowerSkill& skill, const IceFactors& ice,
                             const LackOf& lack_of) {
  Release r{course.first_speed_mps, std::atan2(skill.release.x_m - course.to.x_m, course.to.y_m - skill.release.y_m)};
  Release reached = r;
  for (int i = 0; i < most_iterations; ++i) {
    const Place from = release_place(skill, r.heading_rad);
    const std::optional<Lack> lack = lack_of(released(order_of(r, curl, skill), from), ice);
    if (!lack) {
      r = {0.5 * (r.speed_mps + reached.speed_mps), 0.5 * (r.heading_rad + reached.heading_rad)};
      continue;
    }
    if (lack->close) return r;
    reached = r;
    const Eigen::Matrix2d by_release = by_speed_and_heading(lack->by_start, r, skill);
    const Eigen::Vector2d step = by_release.inverse() * lack->miss;
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
Eigen::Matrix2d spread(const ByStart& by_start, const Release& r, const ThrowerSkill& skill, const IceModel& ice) {
  const Eigen::Matrix2d by_release = by_start.middleCols<2>(2) * velocity_by_release(r);
  const Eigen::Matrix<double, 2, 3> by_ice = by_start.rightCols<3>();
  const Eigen::Vector2d thrower(std::pow(skill.speed_sigma_mps, 2), std::pow(skill.heading_sigma_rad, 2));
  return by_release * thrower.asDiagonal() * by_release.transpose() +
         by_ice * ice.throw_covariance() * by_ice.transpose();
}

template <class Aim>
Aim refused(std::string reason) {
  Aim aim;
  aim.reason = std::move(reason);
  return aim;
}

/// A wished-for place to rest.
struct Drawing {
  using Aim = ShotAim;
  const ShotWish& wish;

  Course course(const ThrowerSkill& skill, const IceFactors& ice) const {
    const double way_m = std::hypot(wish.rest.x_m - skill.release.x_m, wish.rest.y_m - skill.release.y_m);
    return {wish.rest, std::sqrt(2.0 * 0.085 * ice.friction_scale * way_m)};
  }
  std::optional<Lack> lack(const SlidingStone& start, const IceFactors& ice) const {
    const Rest rest = rest_of(start, ice);
    const Eigen::Vector2d miss(wish.rest.x_m - rest.x_m, wish.rest.y_m - rest.y_m);
    return Lack{miss, miss.norm() < close_enough_m, rest.by_start};
  }
  /// Fills in what the way leads to; says until when the way must be free.
  double outcome(const StonePath& path, const Release& r, const ThrowerSkill& skill, const IceModel& ice,
                 Aim& aim) const {
    const Rest rest = path.rest();
    const Eigen::Matrix2d c = spread(rest.by_start, r, skill, ice);
    aim.rest = {rest.x_m, rest.y_m};
    aim.covariance = {c(0, 0), c(0, 1), c(1, 1)};
    return rest.after_s;
  }
  static double doubt(const Aim& aim) { return aim.covariance.xx_m2 + aim.covariance.yy_m2; }
};

/// The stone where its path crosses the contact's y, with derivatives of x there and of the speed there by the seven of
/// the start: a change at the moment, and one of the moment.
struct Passage {
  double x_m = 0.0;
  double speed_mps = 0.0;
  double heading_rad = 0.0;
  double after_s = 0.0;
  ByStart by_start = ByStart::Zero();
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

/// A wished-for place to pass with a speed. Solved on the square of the speed, which is nearly linear in the release.
struct Hitting {
  using Aim = HitAim;
  const HitWish& wish;

  Course course(const ThrowerSkill& skill, const IceFactors& ice) const {
    const double dy = wish.contact.y_m - skill.release.y_m;
    return {wish.contact, std::sqrt(wish.speed_mps * wish.speed_mps + 0.25 * ice.friction_scale * dy)};
  }
  std::optional<Lack> lack(const SlidingStone& start, const IceFactors& ice) const {
    const auto p = passage(StonePath(start, ice), wish.contact.y_m);
    if (!p) return std::nullopt;
    const double square = wish.speed_mps * wish.speed_mps - p->speed_mps * p->speed_mps;
    const Eigen::Vector2d miss(wish.contact.x_m - p->x_m, square / (2.0 * p->speed_mps));
    return Lack{miss, std::abs(miss[0]) < close_enough_aside_m && std::abs(miss[1]) < close_enough_mps, p->by_start};
  }
  double outcome(const StonePath& path, const Release& r, const ThrowerSkill& skill, const IceModel& ice,
                 Aim& aim) const {
    const Passage p = *passage(path, wish.contact.y_m);
    const Eigen::Matrix2d c = spread(p.by_start, r, skill, ice);
    aim.speed_mps = p.speed_mps;
    aim.heading_rad = p.heading_rad;
    aim.aside_sigma_m = std::sqrt(c(0, 0));
    aim.speed_sigma_mps = std::sqrt(c(1, 1));
    return p.after_s;
  }
  static double doubt(const Aim& aim) { return aim.aside_sigma_m; }
};

template <class Kind>
typename Kind::Aim aim_with(Curl curl, const Kind& kind, const ThrowerSkill& skill, const IceModel& ice) {
  using Aim = typename Kind::Aim;
  const IceFactors factors = ice.estimate().factors();
  const auto lack_of = [&](const SlidingStone& start, const IceFactors& on) { return kind.lack(start, on); };
  const auto release = solve(kind.course(skill, factors), curl, skill, factors, lack_of);
  if (!release) return refused<Aim>("no release brings a stone there");
  if (release->speed_mps > skill.max_speed_mps) return refused<Aim>("the thrower is not fast enough");
  Aim aim;
  aim.order = order_of(*release, curl, skill);
  const StonePath path(released(aim.order, release_place(skill, aim.order.heading_rad)), factors);
  const double until_s = kind.outcome(path, *release, skill, ice, aim);
  aim.clearance_m = clearance(path, until_s, kind.wish.stones);
  aim.ok = aim.clearance_m > 0.0;
  if (!aim.ok) aim.reason = "the way is not free";
  return aim;
}

// More clearance than a hand's breadth is worth nothing: then the surer one.
template <class Kind>
bool better(const typename Kind::Aim& a, const typename Kind::Aim& b) {
  const double enough_m = 0.3;
  if (a.ok != b.ok) return a.ok;
  const double gap_a = std::min(a.clearance_m, enough_m), gap_b = std::min(b.clearance_m, enough_m);
  return gap_a != gap_b ? gap_a > gap_b : Kind::doubt(a) < Kind::doubt(b);
}

template <class Kind>
typename Kind::Aim aim(const Kind& kind, const ThrowerSkill& skill, const IceModel& ice) {
  if (kind.wish.curl) return aim_with(*kind.wish.curl, kind, skill, ice);
  const auto left = aim_with(Curl::counter_clockwise, kind, skill, ice);
  const auto right = aim_with(Curl::clockwise, kind, skill, ice);
  return better<Kind>(right, left) ? right : left;
}

std::string impossible(const Place& wish, const ThrowerSkill& skill) {
  const double sum = wish.x_m + wish.y_m + skill.release.x_m + skill.release.y_m + skill.spin_radps;
  if (!std::isfinite(sum)) return "the wish is not finite";
  if (wish.y_m < skill.release.y_m + 1.0) return "the wanted place is not down-ice of the release";
  return {};
}

}  // namespace

Place release_place(const ThrowerSkill& skill, double heading_rad) {
  const double aside_m = skill.line_through_hack ? std::tan(heading_rad) * skill.release.y_m : 0.0;
  return {skill.release.x_m - aside_m, skill.release.y_m};
}

SlidingStone released(const ShotOrder& order, const Place& release) {
  const double spin = order.curl == Curl::counter_clockwise ? order.spin_radps : -order.spin_radps;
  return {release.x_m, release.y_m, -order.speed_mps * std::sin(order.heading_rad),
          order.speed_mps * std::cos(order.heading_rad), spin};
}

ShotAim aim_shot(const ShotWish& wish, const ThrowerSkill& skill, const IceModel& ice) {
  if (std::string why = impossible(wish.rest, skill); !why.empty()) return refused<ShotAim>(std::move(why));
  return aim(Drawing{wish}, skill, ice);
}

HitAim aim_hit(const HitWish& wish, const ThrowerSkill& skill, const IceModel& ice) {
  if (std::string why = impossible(wish.contact, skill); !why.empty()) return refused<HitAim>(std::move(why));
  if (!(wish.speed_mps > 0.05) || !std::isfinite(wish.speed_mps))
    return refused<HitAim>("the wanted speed is none of a hit");
  return aim(Hitting{wish}, skill, ice);
}

}  // namespace hogline::servo
