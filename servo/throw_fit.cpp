#include "servo/throw_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "servo/stone_path.hpp"

namespace hogline::servo {
namespace {

// x, y, vx, vy; friction, curl, lateral of the ice; the throw's share of friction; each view's shared error.
constexpr int throw_deviation = 7;
constexpr int first_view = 8;
constexpr int parameter_count = first_view + view_count;
using Parameters = Eigen::Matrix<double, parameter_count, 1>;
using Information = Eigen::Matrix<double, parameter_count, parameter_count>;
using LookJacobian = Eigen::Matrix<double, 2, parameter_count>;

constexpr int most_iterations = 40;
constexpr double least_friction = 0.3;
constexpr double greatest_friction = 3.0;

double after_s(const ThrowTrack& track, const TrackLook& look) {
  return seconds(look.stamp - track.looks.front().stamp);
}

Eigen::Matrix2d matrix(const PlaceCovariance& c) {
  return (Eigen::Matrix2d() << c.xx_m2, c.xy_m2, c.xy_m2, c.yy_m2).finished();
}

struct Prior {
  Parameters mean = Parameters::Zero();
  Information information = Information::Zero();
};

Prior prior_of(const IceEstimate& ice, const ThrowFitConfig& config) {
  Prior prior;
  prior.mean.segment<3>(4) << ice.friction_scale, ice.curl_gain, ice.lateral_mps2;
  const Eigen::Matrix3d covariance =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(ice.covariance.data());
  prior.information.block<3, 3>(4, 4) = covariance.inverse();
  prior.information(throw_deviation, throw_deviation) = 1.0 / std::pow(config.throw_friction_sigma, 2);
  for (int i = first_view; i < parameter_count; ++i) prior.information(i, i) = 1.0;
  return prior;
}

/// A straight line with one deceleration through the first looks: good enough to start from.
Parameters guess(const ThrowTrack& track, const Prior& prior) {
  Eigen::Matrix<double, 2, 2> normal = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 2, 2> right = Eigen::Matrix2d::Zero();
  const double first_stretch_s = std::max(2.0, after_s(track, track.looks[track.looks.size() / 4]));
  for (const TrackLook& look : track.looks) {
    const double t = after_s(track, look);
    if (t > first_stretch_s) break;
    const double weight = 1.0 / (look.covariance.xx_m2 + look.covariance.yy_m2);
    const Eigen::Vector2d row(1.0, t);
    normal += weight * row * row.transpose();
    const Eigen::RowVector2d place(look.x_m,
                                   look.y_m + 0.045 * t * t * (track.looks.back().y_m > look.y_m ? 1.0 : -1.0));
    right += weight * row * place;
  }
  const Eigen::Matrix2d line = normal.inverse() * right;
  Parameters u = prior.mean;
  u.head<2>() = line.row(0).transpose();
  u.segment<2>(2) = line.row(1).transpose();
  return u;
}

IceFactors ice_of(const Parameters& u) { return {u[4] * (1.0 + u[throw_deviation]), u[5], u[6]}; }

SlidingStone stone_of(const Parameters& u, double spin_radps) { return {u[0], u[1], u[2], u[3], spin_radps}; }

LookJacobian jacobian_of(const TrackLook& look, const Slid& slid, const Parameters& u) {
  LookJacobian j = LookJacobian::Zero();
  j.leftCols<7>() = slid.by_start.topRows<2>();
  j.col(throw_deviation) = j.col(4) * u[4];
  j.col(4) *= 1.0 + u[throw_deviation];
  j.col(first_view + static_cast<int>(look.view)) = look.tilt.at(slid.stone.x_m, slid.stone.y_m);
  return j;
}

struct Normal {
  Information information = Information::Zero();
  Parameters gradient = Parameters::Zero();
  double cost = 0.0;
  double square_sum = 0.0;  ///< of the used looks' normalised residuals
  int used = 0;
  int rejected = 0;
};

/// Cost and weight of a look at this normalised distance: square, then linear, then constant.
struct Robust {
  double cost;
  double weight;
};
Robust robust(double distance, const ThrowFitConfig& config, bool reject) {
  const double k = config.suspicious_sigmas;
  const double linear = k * (2.0 * std::min(distance, config.rejected_sigmas) - k);
  if (distance <= k) return {distance * distance, 1.0};
  if (reject && distance > config.rejected_sigmas) return {linear, 0.0};
  return {k * (2.0 * distance - k), k / distance};
}

bool possible(const Parameters& u) {
  const double friction = ice_of(u).friction_scale;
  return u.allFinite() && friction > least_friction && friction < greatest_friction && u.segment<2>(2).norm() < 10.0;
}

Normal normal_of(const ThrowTrack& track, const Parameters& u, const Prior& prior, const ThrowFitConfig& config,
                 bool reject) {
  Normal normal;
  const Parameters from_prior = u - prior.mean;
  normal.information = prior.information;
  normal.gradient = prior.information * from_prior;
  normal.cost = from_prior.dot(normal.gradient);
  const StonePath path(stone_of(u, track.spin_radps), ice_of(u));
  for (const TrackLook& look : track.looks) {
    const Slid slid = path.at(after_s(track, look));
    const double shared = u[first_view + static_cast<int>(look.view)];
    const Eigen::Vector2d place =
        Eigen::Vector2d(slid.stone.x_m, slid.stone.y_m) + shared * look.tilt.at(slid.stone.x_m, slid.stone.y_m);
    const Eigen::Vector2d residual = place - Eigen::Vector2d(look.x_m, look.y_m);
    const Eigen::Matrix2d information = matrix(look.covariance).inverse();
    const double square = residual.dot(information * residual);
    const Robust r = robust(std::sqrt(square), config, reject);
    normal.cost += r.cost;
    if (r.weight == 0.0) {
      ++normal.rejected;
      continue;
    }
    ++normal.used;
    normal.square_sum += r.weight * square;
    const LookJacobian j = jacobian_of(look, slid, u);
    normal.information += r.weight * j.transpose() * information * j;
    normal.gradient += r.weight * j.transpose() * (information * residual);
  }
  return normal;
}

struct Solution {
  bool converged = false;
  Parameters u;
  Normal normal;
};

/// Levenberg-Marquardt; once it has come near, looks that nothing explains are left out.
Solution solve(const ThrowTrack& track, const Prior& prior, const ThrowFitConfig& config) {
  Solution s{false, guess(track, prior), {}};
  if (!possible(s.u)) return s;
  bool reject = false;
  double damping = 1e-3;
  s.normal = normal_of(track, s.u, prior, config, reject);
  for (int i = 0; i < most_iterations; ++i) {
    Information damped = s.normal.information;
    damped.diagonal() *= 1.0 + damping;
    const Parameters step = -damped.ldlt().solve(s.normal.gradient);
    const Parameters next = s.u + step;
    const double decrement = step.dot(s.normal.information * step);
    if (possible(next)) {
      const Normal normal = normal_of(track, next, prior, config, reject);
      if (normal.cost <= s.normal.cost + 1e-9) {
        s.u = next;
        s.normal = normal;
        damping = std::max(damping * 0.1, 1e-9);
        if (decrement > 1e-4) continue;
        if (reject) return s.converged = true, s;
        reject = true;
        s.normal = normal_of(track, s.u, prior, config, reject);
        continue;
      }
    }
    if (decrement < 1e-6 && reject) return s.converged = true, s;
    damping = std::max(damping, 1e-6) * 10.0;
  }
  return s;
}

std::string unusable(const ThrowTrack& track, const IceEstimate& prior, const ThrowFitConfig& config) {
  if (static_cast<int>(track.looks.size()) < config.least_looks) return "too few looks";
  const auto finite = [](const TrackLook& l) {
    const double det = l.covariance.xx_m2 * l.covariance.yy_m2 - l.covariance.xy_m2 * l.covariance.xy_m2;
    return std::isfinite(l.x_m) && std::isfinite(l.y_m) && std::isfinite(l.tilt.at(l.x_m, l.y_m).sum()) &&
           std::isfinite(det) && det > 0.0 && l.covariance.xx_m2 > 0.0;
  };
  if (!std::all_of(track.looks.begin(), track.looks.end(), finite)) return "a look is not finite or has no covariance";
  const auto before = [](const TrackLook& a, const TrackLook& b) { return a.stamp < b.stamp; };
  if (!std::is_sorted(track.looks.begin(), track.looks.end(), before)) return "looks are not in order";
  const TrackLook &first = track.looks.front(), &last = track.looks.back();
  if (std::hypot(last.x_m - first.x_m, last.y_m - first.y_m) < config.least_way_m) return "too short a way";
  if (!std::isfinite(track.spin_radps)) return "the spin is not finite";
  if (prior.friction_scale <= least_friction || prior.friction_scale >= greatest_friction)
    return "no ice has this prior";
  return {};
}

Information covariance_of(const Solution& s) {
  // Each look has two residuals; seven parameters are fitted to them.
  const double freedom = std::max(1.0, 2.0 * s.normal.used - 7.0);
  const double widen = std::max(1.0, s.normal.square_sum / freedom);
  return widen * s.normal.information.ldlt().solve(Information::Identity());
}

ThrowFit fit_of(const Solution& s, const ThrowTrack& track, const IceEstimate& prior) {
  ThrowFit fit;
  fit.start = track.looks.front().stamp;
  fit.stone = stone_of(s.u, track.spin_radps);
  fit.ice = ice_of(s.u);
  fit.used = s.normal.used;
  fit.rejected = s.normal.rejected;
  fit.residual = std::sqrt(s.normal.square_sum / std::max(1.0, 2.0 * s.normal.used - 7.0));
  for (int i = 0; i < view_count; ++i) fit.shared_sigmas[static_cast<std::size_t>(i)] = s.u[first_view + i];

  const Information covariance = covariance_of(s);
  Eigen::Matrix<double, 7, parameter_count> to_throw = Eigen::Matrix<double, 7, parameter_count>::Zero();
  to_throw.leftCols<7>().setIdentity();
  to_throw(4, 4) = 1.0 + s.u[throw_deviation];
  to_throw(4, throw_deviation) = s.u[4];
  fit.covariance = to_throw * covariance * to_throw.transpose();
  fit.learnt = {s.u[4], s.u[5], s.u[6], {}, prior.throws + 1};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(fit.learnt.covariance.data()) = covariance.block<3, 3>(4, 4);
  fit.ok = covariance.allFinite() && covariance.diagonal().minCoeff() > 0.0;
  if (!fit.ok) fit.reason = "the looks do not determine the throw";
  return fit;
}

}  // namespace

ThrowFit fit_throw(const ThrowTrack& track, const IceEstimate& prior, const ThrowFitConfig& config) {
  ThrowFit fit;
  fit.reason = unusable(track, prior, config);
  if (!fit.reason.empty()) return fit;
  const Solution solution = solve(track, prior_of(prior, config), config);
  if (!solution.converged) {
    fit.reason = "no ice explains the trajectory";
    return fit;
  }
  if (2 * solution.normal.rejected > static_cast<int>(track.looks.size())) {
    fit.reason = "most looks do not fit one trajectory";
    return fit;
  }
  return fit_of(solution, track, prior);
}

}  // namespace hogline::servo
