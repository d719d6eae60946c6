#include "vision/run_motion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "vision/geometry/pose.hpp"

namespace hogline::vision {
namespace {

constexpr double acceleration_sigma_mps2 = 0.8;  // of a run: 0.9 m/s2 at most
constexpr double jerk_sigma_mps3 = 2.0;
constexpr double sway_mps = 0.02;  // a camera half a metre up on a body that rocks is as much faster or slower
constexpr double across_sigma_mps2 = 0.2;
constexpr double yaw_acceleration_sigma_radps2 = 0.2;
/// What a rate may be before any place is known.
struct Rate {
  double mean;
  double sigma;
};
constexpr Rate any_speed_mps{1.75, 1.05};  // from rest to 3.5 m/s
constexpr Rate any_sideways_mps{0.0, 0.35};
constexpr Rate any_yaw_rate_radps{0.0, 0.2};

/// Value, rate and half the rate's change, at the newest place.
class Path {
 public:
  /// The third number is zero within this; what it leaves out bends the path by `bend` * t^power.
  Path(const Rate& rate, double rate_change_sigma, double bend, int power) : bend_(bend), power_(power) {
    information_(1, 1) = 1.0 / (rate.sigma * rate.sigma);
    pull_[1] = rate.mean * information_(1, 1);
    information_(2, 2) = 4.0 / (rate_change_sigma * rate_change_sigma);
  }

  void add(double t, double value, double sigma) {
    const Eigen::Vector3d row(1.0, t, t * t);
    const double s = std::hypot(sigma, bend_ * std::pow(std::abs(t), power_));
    information_ += row * row.transpose() / (s * s);
    pull_ += value / (s * s) * row;
  }

  void solve() {
    const auto factors = information_.ldlt();
    numbers_ = factors.solve(pull_);
    covariance_ = factors.solve(Eigen::Matrix3d::Identity());
  }
  double value(double t) const { return numbers_.dot(Eigen::Vector3d(1.0, t, t * t)); }
  double rate(double t) const { return numbers_[1] + 2.0 * t * numbers_[2]; }
  double sigma(double t) const {
    const Eigen::Vector3d row(1.0, t, t * t);
    return std::hypot(std::sqrt(std::max(0.0, row.dot(covariance_ * row))), bend_ * std::pow(t, power_));
  }

 private:
  double bend_;
  int power_;
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d pull_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d numbers_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

Path along_path() { return {any_speed_mps, acceleration_sigma_mps2, jerk_sigma_mps3 / 6.0, 3}; }

}  // namespace

void RunMotion::add(Stamp stamp, const RunPlace& place) {
  assert(count_ == 0 || stamp > last_stamp());
  std::size_t old = count_ == most_places ? 1 : 0;
  while (old < count_ && seconds(stamp - places_[old].stamp) > longest_s) ++old;
  std::copy(places_.begin() + static_cast<std::ptrdiff_t>(old), places_.begin() + static_cast<std::ptrdiff_t>(count_),
            places_.begin());
  count_ -= old;
  places_[count_++] = {stamp, place};
}

RunPlace RunMotion::at(Stamp stamp) const {
  assert(!empty() && stamp >= last_stamp());
  const double dt_s = seconds(stamp - last_stamp());
  Path x{any_sideways_mps, across_sigma_mps2, 0.0, 3};
  Path y = along_path();
  Path yaw{any_yaw_rate_radps, yaw_acceleration_sigma_radps2, 0.0, 3};
  for (std::size_t i = 0; i < count_; ++i) {
    const double t = seconds(places_[i].stamp - last_stamp());
    const RunPlace& p = places_[i].place;
    x.add(t, p.body.x_m, p.sigma.x_m);
    y.add(t, p.body.y_m, p.sigma.y_m);
    yaw.add(t, p.body.yaw_rad, p.sigma.yaw_rad);
  }
  for (Path* path : {&x, &y, &yaw}) path->solve();
  return {.body = {x.value(dt_s), y.value(dt_s), wrapped(yaw.value(dt_s))},
          .sigma = {x.sigma(dt_s), std::hypot(y.sigma(dt_s), sway_mps * dt_s), yaw.sigma(dt_s)}};
}

double RunMotion::speed_mps(Stamp stamp) const {
  assert(!empty());
  Path y = along_path();
  for (std::size_t i = 0; i < count_; ++i) {
    const RunPlace& p = places_[i].place;
    y.add(seconds(places_[i].stamp - last_stamp()), p.body.y_m, p.sigma.y_m);
  }
  y.solve();
  return y.rate(seconds(stamp - last_stamp()));
}

}  // namespace hogline::vision
