#include "servo/stone_rotation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hogline::servo {
namespace {

constexpr std::size_t least_looks = 10;
constexpr double least_span_s = 1.0;
constexpr double longest_gap_s = 0.6;
constexpr double greatest_residual_rad = 0.4;
constexpr double step_s = 0.02;

/// How far the handle lags behind a steady turn, per unit of loss: the double integral of 0.025 / v.
class Lag {
 public:
  explicit Lag(const StonePath& path) : path_(path) {}
  /// Precondition: times do not fall.
  double at(double after_s) {
    while (t_ < after_s) {
      const double h = std::min(step_s, after_s - t_);
      const double middle = rate_ + 0.5 * h * loss(t_ + 0.5 * h);
      rate_ += h * loss(t_ + 0.5 * h);
      lag_ += h * middle;
      t_ += h;
    }
    return lag_;
  }

 private:
  double loss(double t) const { return 0.025 / std::max(speed_mps(path_.at(t).stone), 0.001); }
  const StonePath& path_;
  double t_ = 0.0;
  double rate_ = 0.0;
  double lag_ = 0.0;
};

double nearest_half_turn(double angle) { return angle - std::numbers::pi * std::round(angle / std::numbers::pi); }

/// One angle that does not jump. Each look is taken at the half turn nearest to what the last ones foretell.
std::vector<double> unwrapped(const std::vector<HandleLook>& looks) {
  std::vector<double> angles{looks.front().handle_rad};
  double rate = 0.0;
  for (std::size_t i = 1; i < looks.size(); ++i) {
    const double dt = looks[i].after_s - looks[i - 1].after_s;
    const double foretold = angles.back() + rate * dt;
    angles.push_back(foretold + nearest_half_turn(looks[i].handle_rad - foretold));
    // The rate over the last half second or so.
    std::size_t first = i;
    while (first > 0 && looks[i].after_s - looks[first - 1].after_s < 0.7) --first;
    const double span = looks[i].after_s - looks[first].after_s;
    if (span > 0.2) rate = (angles[i] - angles[first]) / span;
  }
  return angles;
}

StoneRotation unknown(std::string reason) {
  StoneRotation rotation;
  rotation.reason = std::move(reason);
  return rotation;
}

}  // namespace

StoneRotation rotation_of(const std::vector<HandleLook>& looks, const StonePath& path) {
  if (looks.size() < least_looks) return unknown("the handle was seen too seldom");
  if (looks.back().after_s - looks.front().after_s < least_span_s) return unknown("the handle was seen too shortly");
  for (std::size_t i = 1; i < looks.size(); ++i) {
    if (looks[i].after_s - looks[i - 1].after_s > longest_gap_s) return unknown("the handle was hidden for too long");
  }
  const std::vector<double> angles = unwrapped(looks);
  const double sense = angles.back() > angles.front() ? 1.0 : -1.0;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  normal(2, 2) = 1.0 / (0.5 * 0.5) * 0.01;  // loss 1 +- 0.5, a look 0.1 rad
  right[2] = normal(2, 2);
  Lag lag(path);
  std::vector<Eigen::Vector3d> rows;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    rows.emplace_back(1.0, looks[i].after_s, -sense * lag.at(looks[i].after_s));
    normal += rows.back() * rows.back().transpose();
    right += rows.back() * angles[i];
  }
  const Eigen::Vector3d u = normal.ldlt().solve(right);
  double square = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) square += std::pow(rows[i].dot(u) - angles[i], 2);
  const double variance = square / static_cast<double>(rows.size() - 3);
  if (!(std::sqrt(variance) < greatest_residual_rad)) return unknown("the handle's directions do not make one turn");
  const double spin_variance = variance * normal.ldlt().solve(Eigen::Matrix3d::Identity())(1, 1);
  return {true, {}, u[1], std::sqrt(spin_variance), u[2]};
}

}  // namespace hogline::servo
