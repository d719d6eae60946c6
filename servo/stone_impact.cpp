#include "servo/stone_impact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::servo {
namespace {

constexpr double touch_m = 2.0 * stone_radius_m;
constexpr double sigmas_that_count = 3.0;
constexpr double slowest_meeting_mps = 0.02;

/// The meeting seen along the relative velocity: `ahead` to the struck stone's centre, `aside` to its left.
struct Approach {
  double speed_mps = 0.0;
  Eigen::Vector2d along = Eigen::Vector2d::Zero();
  Eigen::Vector2d left = Eigen::Vector2d::Zero();
  double ahead_m = 0.0;
  double aside_m = 0.0;
  double aside_sigma_m = 0.0;
};

Eigen::Vector2d place(const StoneMotion& m) { return {m.stone.x_m, m.stone.y_m}; }
Eigen::Vector2d velocity(const StoneMotion& m) { return {m.stone.vx_mps, m.stone.vy_mps}; }
Eigen::Matrix2d place_covariance(const StoneMotion& m) { return m.covariance.topLeftCorner<2, 2>(); }

Approach approach(const StoneMotion& striker, const StoneMotion& struck) {
  const Eigen::Vector2d closing = velocity(striker) - velocity(struck);
  const Eigen::Vector2d apart = place(struck) - place(striker);
  Approach a;
  a.speed_mps = closing.norm();
  if (a.speed_mps < slowest_meeting_mps) return a;
  a.along = closing / a.speed_mps;
  a.left = Eigen::Vector2d(-a.along.y(), a.along.x());
  a.ahead_m = apart.dot(a.along);
  a.aside_m = apart.dot(a.left);
  a.aside_sigma_m = std::sqrt(a.left.dot((place_covariance(striker) + place_covariance(struck)) * a.left));
  return a;
}

double normal_mass(double from, double to) {
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  return below(to) - below(from);
}

double touching(const Approach& a) {
  return normal_mass((-touch_m - a.aside_m) / a.aside_sigma_m, (touch_m - a.aside_m) / a.aside_sigma_m);
}

double ahead_at_touch(double aside_m) { return std::sqrt(std::max(0.0, touch_m * touch_m - aside_m * aside_m)); }

/// New place and velocity at the same stamp; what was known of how they go together is lost.
void deflect(StoneMotion& m, const Eigen::Vector2d& to_place, const Eigen::Vector2d& to_velocity,
             const Eigen::Matrix2d& places, const Eigen::Matrix2d& velocities) {
  m.stone.x_m = to_place.x(), m.stone.y_m = to_place.y();
  m.stone.vx_mps = to_velocity.x(), m.stone.vy_mps = to_velocity.y();
  m.covariance.topRows<4>().setZero();
  m.covariance.leftCols<4>().setZero();
  m.covariance.topLeftCorner<2, 2>() = places;
  m.covariance.block<2, 2>(2, 2) = velocities;
}

/// A struck stone runs on the striker's ice and may curl either way.
void set_off(StoneMotion& struck, const StoneMotion& striker) {
  struck.ice = striker.ice;
  struck.covariance.block<3, 3>(4, 4) = striker.covariance.block<3, 3>(4, 4);
  curl_either_way(struck);
}

/// The impact in which the struck stone's centre passes `aside_m` to the left, known to `sigma_m`.
Impact impact_at(double aside_m, double sigma_m, const Approach& a, const StoneMotion& striker,
                 const StoneMotion& struck, const ImpactConfig& config) {
  const double sine = std::clamp(aside_m / touch_m, -1.0, 1.0);
  const double cosine = std::sqrt(std::max(1.0 - sine * sine, 0.0));
  const Eigen::Vector2d centres = cosine * a.along + sine * a.left;
  const Eigen::Vector2d across = -sine * a.along + cosine * a.left;
  const double impulse = 0.5 * (1.0 + config.restitution) * a.speed_mps * cosine;
  const double slip = -sine * a.speed_mps;
  const double rub = std::clamp(slip / 6.0, -config.friction * impulse, config.friction * impulse);
  const Eigen::Vector2d change = impulse * centres + rub * across;

  // What of the change is not known: bounce, friction, and how full the hit was.
  const double bounce = 0.5 * config.restitution_sigma * a.speed_mps * cosine;
  const double rubbing = config.friction_sigma * impulse;
  const double turn = std::min(sigma_m / (touch_m * std::max(cosine, 0.2)), 0.3);
  const double least = config.least_velocity_sigma_mps;
  const Eigen::Vector2d turned =
      0.5 * (1.0 + config.restitution) * a.speed_mps * turn * (cosine * across - sine * centres);
  const Eigen::Matrix2d changes = bounce * bounce * centres * centres.transpose() +
                                  rubbing * rubbing * across * across.transpose() + turned * turned.transpose() +
                                  least * least * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d places = place_covariance(striker) + place_covariance(struck);

  // As if they had touched at once, and gone on or back with the new velocities to the handed stamp.
  const double after_s = (a.ahead_m - ahead_at_touch(aside_m)) / a.speed_mps;
  const Eigen::Vector2d shift = (a.aside_m - aside_m) * a.left;
  Impact impact{0.0, striker, struck};
  set_off(impact.struck, striker);
  deflect(impact.striker, place(striker) + shift + change * after_s, velocity(striker) - change, places,
          striker.covariance.block<2, 2>(2, 2) + changes);
  deflect(impact.struck, place(struck) - change * after_s, velocity(struck) + change, places, changes);
  return impact;
}

}  // namespace

std::optional<Meeting> meeting(const StoneMotion& striker, const StoneMotion& struck) {
  const Approach a = approach(striker, struck);
  if (a.speed_mps < slowest_meeting_mps || a.ahead_m <= 0.0) return std::nullopt;
  if (std::abs(a.aside_m) > touch_m + sigmas_that_count * a.aside_sigma_m) return std::nullopt;
  const double aside = std::clamp(a.aside_m, -0.9 * touch_m, 0.9 * touch_m);
  return Meeting{std::max(0.0, (a.ahead_m - ahead_at_touch(aside)) / a.speed_mps), touching(a)};
}

std::vector<Impact> impacts(const StoneMotion& striker, const StoneMotion& struck, const ImpactConfig& config) {
  const Approach a = approach(striker, struck);
  const double edge = 0.999 * touch_m;
  const double from = std::clamp(a.aside_m - sigmas_that_count * a.aside_sigma_m, -edge, edge);
  const double to = std::clamp(a.aside_m + sigmas_that_count * a.aside_sigma_m, -edge, edge);
  // The direction in which the struck stone leaves is cut into parts of some degrees.
  const double spread_rad = std::asin(to / touch_m) - std::asin(from / touch_m);
  const int parts = std::clamp(static_cast<int>(std::ceil(spread_rad / 0.25)), 1, config.most_parts);
  const double width = (to - from) / parts;
  std::vector<Impact> all;
  double whole = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double low = from + i * width, high = low + width;
    const double middle = parts == 1 ? std::clamp(a.aside_m, from, to) : 0.5 * (low + high);
    const double sigma = parts == 1 ? a.aside_sigma_m : width / std::sqrt(12.0);
    Impact impact = impact_at(middle, sigma, a, striker, struck, config);
    impact.probability = normal_mass((low - a.aside_m) / a.aside_sigma_m, (high - a.aside_m) / a.aside_sigma_m) + 1e-9;
    whole += impact.probability;
    all.push_back(impact);
  }
  for (Impact& impact : all) impact.probability /= whole;
  return all;
}

}  // namespace hogline::servo
