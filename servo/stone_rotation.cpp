#include "servo/stone_rotation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace hogline::servo {
namespace {

using std::numbers::pi;

constexpr std::size_t least_looks = 10;
constexpr std::size_t most_tried = 150;  // looks, while rates are tried
constexpr double least_span_s = 1.0;
constexpr double step_s = 0.02;
constexpr double most_spin_radps = 8.0;
constexpr double common_rad = 0.06;  // what a look is wrong by beside its sigma: other makers' grips
constexpr double loss_sigma = 0.5;   // of FCV1's
constexpr double most_loss = 2.0;
constexpr double least_agreement = 0.6;  // 1: all looks on one line; random ones stay below a half
constexpr double as_good = 0.9;          // another rate that agrees so well beside the best
constexpr double wild_sigmas = 3.5;
constexpr double wild_share = 0.4;  // of the looks, at most
constexpr double greatest_residual_rad = 0.4;
constexpr double correlated = 1.5;  // neighbouring looks share their errors

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

double nearest_half_turn(double angle) { return angle - pi * std::round(angle / pi); }

/// A look, and how far the handle lags there.
struct Row {
  double after_s, handle_rad, sigma_rad, lag;
};

std::vector<Row> rows_of(const std::vector<HandleLook>& looks, const StonePath& path) {
  Lag lag(path);
  std::vector<Row> rows;
  for (const HandleLook& l : looks) {
    rows.push_back({l.after_s, l.handle_rad, std::hypot(l.sigma_rad, common_rad), lag.at(l.after_s)});
  }
  return rows;
}

/// A rate and a loss, and how well the looks agree on one handle that turns so.
struct Turn {
  double spin_radps = 0.0;
  double loss = 1.0;
  double agreement = 0.0;  ///< 0..1
};

/// Directions doubled: half a turn is a whole one then, and what agrees adds up.
class Trials {
 public:
  explicit Trials(const std::vector<Row>& rows) : rows_(rows) {
    const double middle_s = 0.5 * (rows.front().after_s + rows.back().after_s);
    double sum = 0.0;
    for (const Row& r : rows) sum += weight(r);
    for (const Row& r : rows) {
      after_s_.push_back(r.after_s - middle_s);
      looks_.push_back(std::polar(weight(r) / sum, 2.0 * r.handle_rad));
    }
  }

  /// All rates of one sense with one loss, in steps.
  void sweep(double sense, double loss, double step_radps, int steps, std::vector<Turn>& turns) const {
    std::vector<std::complex<double>> turned, by_step;
    for (std::size_t i = 0; i < looks_.size(); ++i) {
      turned.push_back(looks_[i] * std::polar(1.0, 2.0 * sense * loss * rows_[i].lag));
      by_step.push_back(std::polar(1.0, -2.0 * sense * step_radps * after_s_[i]));
    }
    for (int k = 0; k <= steps; ++k) {
      std::complex<double> sum = 0.0;
      for (std::size_t i = 0; i < turned.size(); ++i) {
        sum += turned[i];
        turned[i] *= by_step[i];
      }
      turns.push_back({sense * step_radps * k, loss, std::abs(sum)});
    }
  }

 private:
  static double weight(const Row& r) { return 1.0 / (r.sigma_rad * r.sigma_rad); }
  const std::vector<Row>& rows_;
  std::vector<double> after_s_;
  std::vector<std::complex<double>> looks_;
};

/// Some of the looks, spread over all.
std::vector<Row> thinned(const std::vector<Row>& rows) {
  if (rows.size() <= most_tried) return rows;
  std::vector<Row> some;
  for (std::size_t i = 0; i < most_tried; ++i) some.push_back(rows[i * rows.size() / most_tried]);
  return some;
}

double fastest_radps(const std::vector<Row>& rows) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < rows.size(); ++i) gaps.push_back(rows[i].after_s - rows[i - 1].after_s);
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return std::min(most_spin_radps, 0.45 * pi / std::max(1e-3, *middle));
}

struct Best {
  Turn turn;
  bool alone = true;  ///< no other rate agrees as well
};

Best best_of(const std::vector<Row>& rows) {
  const double span_s = rows.back().after_s - rows.front().after_s;
  const double step_radps = 0.4 / span_s;
  const double lagged = rows.back().lag - rows.front().lag;
  const int steps = static_cast<int>(fastest_radps(rows) / step_radps);
  // A loss that is wrong by half a step leaves half a radian at most.
  const int losses = std::clamp(static_cast<int>(most_loss * lagged), 4, 24);
  const std::vector<Row> some = thinned(rows);
  const Trials trials(some);
  std::vector<Turn> turns;
  for (const double sense : {1.0, -1.0}) {
    for (int i = 0; i <= losses; ++i) trials.sweep(sense, most_loss * i / losses, step_radps, steps, turns);
  }
  const auto worth = [](const Turn& t) { return t.agreement - 0.02 * std::pow((t.loss - 1.0) / loss_sigma, 2); };
  Best best;
  best.turn =
      *std::max_element(turns.begin(), turns.end(), [&](const Turn& a, const Turn& b) { return worth(a) < worth(b); });
  // Rate and loss make up for each other: what turns as far between the first look and the last is the same turn.
  const auto mean_rate = [&](const Turn& t) {
    return t.spin_radps - std::copysign(t.loss * lagged / span_s, t.spin_radps);
  };
  best.alone = std::none_of(turns.begin(), turns.end(), [&](const Turn& t) {
    const bool another = std::abs(mean_rate(t) - mean_rate(best.turn)) * span_s > 2.0;
    return another && worth(t) > as_good * worth(best.turn);
  });
  return best;
}

StoneRotation unknown(std::string reason) {
  StoneRotation rotation;
  rotation.reason = std::move(reason);
  return rotation;
}

// Least squares of the directions about the turn that was found; wild looks are left out.
StoneRotation refined(const std::vector<Row>& rows, const Turn& turn) {
  const double sense = std::copysign(1.0, turn.spin_radps);
  Eigen::Vector3d u(0.0, turn.spin_radps, turn.loss);
  std::complex<double> sum = 0.0;
  const auto row_of = [&](const Row& r) { return Eigen::Vector3d(1.0, r.after_s, -sense * r.lag); };
  for (const Row& r : rows)
    sum += std::polar(1.0 / (r.sigma_rad * r.sigma_rad), 2.0 * (r.handle_rad - row_of(r).dot(u)));
  u[0] = 0.5 * std::arg(sum);
  Eigen::Matrix3d normal;
  double square = 0.0;
  double square_rad2 = 0.0;
  int used = 0;
  for (int round = 0; round < 5; ++round) {
    normal.setZero();
    normal(2, 2) = 1.0 / (loss_sigma * loss_sigma);
    Eigen::Vector3d right(0.0, 0.0, normal(2, 2) * (1.0 - u[2]));
    square = square_rad2 = 0.0;
    used = 0;
    for (const Row& r : rows) {
      const Eigen::Vector3d a = row_of(r);
      const double off = nearest_half_turn(r.handle_rad - a.dot(u));
      const double sigma = r.sigma_rad * (round == 0 ? 2.0 : 1.0);
      if (std::abs(off) > wild_sigmas * sigma) continue;
      const double w = 1.0 / (r.sigma_rad * r.sigma_rad);
      normal += w * a * a.transpose();
      right += w * off * a;
      square += w * off * off;
      square_rad2 += off * off;
      ++used;
    }
    if (used < 4) return unknown("the handle's directions do not make one turn");
    u += normal.ldlt().solve(right);
  }
  const bool one_turn = used >= (1.0 - wild_share) * static_cast<double>(rows.size()) &&
                        std::sqrt(square_rad2 / used) < greatest_residual_rad && u.allFinite();
  if (!one_turn) return unknown("the handle's directions do not make one turn");
  const double scale = std::max(1.0, square / (used - 3));
  const double variance = correlated * scale * normal.ldlt().solve(Eigen::Matrix3d::Identity())(1, 1);
  return {true, {}, u[1], std::sqrt(variance), u[2], used};
}

}  // namespace

StoneRotation rotation_of(const std::vector<HandleLook>& looks, const StonePath& path) {
  if (looks.size() < least_looks) return unknown("the handle was seen too seldom");
  if (looks.back().after_s - looks.front().after_s < least_span_s) return unknown("the handle was seen too shortly");
  const std::vector<Row> rows = rows_of(looks, path);
  const Best best = best_of(rows);
  if (best.turn.agreement < least_agreement) return unknown("the handle's directions do not make one turn");
  if (!best.alone) return unknown("the handle was hidden for too long: several rates agree with what was seen");
  return refined(rows, best.turn);
}

}  // namespace hogline::servo
