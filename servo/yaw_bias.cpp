#include "servo/yaw_bias.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr double least_range_rad = 0.02;       // of the turn: about a degree
constexpr double smallest_pivot_share = 1e-9;  // below this the equations do not determine what is asked
constexpr int samples_per_unknown = 3;

/// Weights of a sample in the two knots it lies between.
struct Place {
  Eigen::Index left = 0;
  double part = 0.0;
};

Place place_of(double estimate_rad, double first_rad, double step_rad, int knots) {
  const double at = std::clamp((estimate_rad - first_rad) / step_rad, 0.0, static_cast<double>(knots - 1));
  const auto left = std::min<Eigen::Index>(static_cast<Eigen::Index>(at), knots - 2);
  return {left, at - static_cast<double>(left)};
}

YawBiasCalibration failed(std::string reason) {
  YawBiasCalibration calibration;
  calibration.reason = std::move(reason);
  return calibration;
}

}  // namespace

double yaw_bias(const YawBiasTable& table, double estimate_rad) {
  if (table.empty()) return 0.0;
  const auto right = std::lower_bound(table.begin(), table.end(), estimate_rad,
                                      [](const YawBiasKnot& knot, double value) { return knot.estimate_rad < value; });
  if (right == table.begin()) return table.front().bias_rad;
  if (right == table.end()) return table.back().bias_rad;
  const YawBiasKnot& left = *(right - 1);
  const double part = (estimate_rad - left.estimate_rad) / (right->estimate_rad - left.estimate_rad);
  return left.bias_rad + part * (right->bias_rad - left.bias_rad);
}

SheetPosePercept without_yaw_bias(SheetPosePercept percept, const YawBiasTable& table) {
  if (percept.ok) percept.body.yaw_rad -= yaw_bias(table, percept.body.yaw_rad);
  return percept;
}

double reference_bias_rad(double left_of_line_m, double way_m) { return -std::atan2(left_of_line_m, way_m); }

YawBiasCalibration calibrate_yaw_bias(const std::vector<TurnSample>& samples, int knots, double reference_estimate_rad,
                                      double reference_bias_rad) {
  if (knots < 2) return failed("two knots at least");
  if (static_cast<int>(samples.size()) < samples_per_unknown * (knots + 2)) return failed("too few looks");
  for (const TurnSample& s : samples) {
    if (!std::isfinite(s.time_s) || !std::isfinite(s.estimate_rad) || !std::isfinite(s.gyro_rad)) {
      return failed("a look or an angle is not finite");
    }
  }
  const auto by_estimate = [](const TurnSample& a, const TurnSample& b) { return a.estimate_rad < b.estimate_rad; };
  const auto [lowest, highest] = std::minmax_element(samples.begin(), samples.end(), by_estimate);
  const double first_rad = lowest->estimate_rad;
  const double range_rad = highest->estimate_rad - first_rad;
  if (range_rad < least_range_rad) return failed("the turn is too small");
  if (!(std::abs(reference_bias_rad) < 0.5)) return failed("the reference's bias is not a small angle");
  const double step_rad = range_rad / (knots - 1);

  // Unknown: the knots' bias, the gyro's angle at estimate zero (tied to the reference below), the gyro's bias.
  const Eigen::Index n = knots + 2;
  const auto row_of = [&](const TurnSample& s) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    const Place place = place_of(s.estimate_rad, first_rad, step_rad, knots);
    row[place.left] = 1.0 - place.part;
    row[place.left + 1] = place.part;
    row[knots] = -1.0;
    row[knots + 1] = -(s.time_s - samples.front().time_s);
    return row;
  };
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (const TurnSample& s : samples) {
    const Eigen::VectorXd row = row_of(s);
    normal += row * row.transpose();
    right += row * (s.estimate_rad - s.gyro_rad);
  }
  Eigen::VectorXd reference = Eigen::VectorXd::Zero(n);
  const Place at = place_of(reference_estimate_rad, first_rad, step_rad, knots);
  reference[at.left] = 1.0 - at.part;
  reference[at.left + 1] = at.part;
  const double weight = static_cast<double>(samples.size());
  normal += weight * reference * reference.transpose();
  right += weight * reference * reference_bias_rad;

  const Eigen::LDLT<Eigen::MatrixXd> factors(normal);
  const Eigen::VectorXd pivots = factors.vectorD();
  if (factors.info() != Eigen::Success || !(pivots.minCoeff() > smallest_pivot_share * pivots.maxCoeff())) {
    return failed("the looks do not determine the table: turn there and back, evenly");
  }
  const Eigen::VectorXd solution = factors.solve(right);

  YawBiasCalibration calibration;
  double squares = 0.0;
  for (const TurnSample& s : samples) {
    squares += std::pow(row_of(s).dot(solution) - (s.estimate_rad - s.gyro_rad), 2);
  }
  calibration.residual_rad = std::sqrt(squares / static_cast<double>(samples.size()));
  for (int i = 0; i < knots; ++i) {
    calibration.table.push_back({first_rad + i * step_rad, solution[i]});
    calibration.largest_rad = std::max(calibration.largest_rad, std::abs(solution[i] - reference_bias_rad));
  }
  calibration.gyro_bias_radps = solution[knots + 1];
  calibration.ok = solution.allFinite();
  if (!calibration.ok) calibration.reason = "the solution is not finite";
  return calibration;
}

}  // namespace hogline::servo
