#include "vision/detect/line_classes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr double slack_m = 0.4;  // of intercepts: the mount's tilt moves far ice by decimetres

double folded(double angle) {  // to (-90, 90] degrees: a line has no sense
  while (angle > std::numbers::pi / 2.0) angle -= std::numbers::pi;
  while (angle <= -std::numbers::pi / 2.0) angle += std::numbers::pi;
  return angle;
}

struct OnIce {
  Eigen::Vector2d begin;
  Eigen::Vector2d end;
};

std::optional<OnIce> on_ice(const LineCandidate& line, const GroundView& view) {
  const auto begin = view.ground_of_plane(line.begin);
  const auto end = view.ground_of_plane(line.end);
  if (!begin || !end || (*end - *begin).norm() < 0.3) return std::nullopt;
  return OnIce{*begin, *end};
}

}  // namespace

LineClasses classify(const std::vector<LineCandidate>& lines, const GroundView& view, const StandingRange& range) {
  LineClasses classes;
  const double nearest_hog_m = rules::tee_to_hog_m - range.max_y_m - slack_m;
  const double farthest_hog_m = rules::tee_to_hog_m - range.min_y_m + slack_m;
  const double slope_limit = range.max_yaw_rad + 0.03;
  for (const LineCandidate& line : lines) {
    const auto ice = on_ice(line, view);
    if (!ice) continue;
    const Eigen::Vector2d d = (ice->end - ice->begin).normalized();
    const Eigen::Vector2d n(-d.y(), d.x());
    const double offset = n.dot(ice->begin);  // of the line from b's origin, along n
    const double across_slope = folded(std::atan2(d.y(), d.x()));
    const double down_slope = folded(std::atan2(-d.x(), d.y()));
    if (std::abs(across_slope) < slope_limit) {
      const ClassifiedLine c{line, across_slope, n.y() > 0.0 ? offset : -offset};
      classes.across.push_back(c);
      if (c.intercept_m > nearest_hog_m && c.intercept_m < farthest_hog_m) classes.hog.push_back(c);
    } else if (std::abs(down_slope) < slope_limit) {
      const ClassifiedLine c{line, down_slope, n.x() > 0.0 ? offset : -offset};
      classes.down_ice.push_back(c);
      // At yaw psi a robot at (x, y) has the sideline at w/2 - x to its right along the line's normal, whatever y is,
      // but its own place is measured from the tee: the turn adds nothing to a perpendicular distance.
      const double nearest_m = rules::min_width_m / 2.0 - range.max_x_m;
      const double farthest_m = rules::max_width_m / 2.0 + range.max_x_m;
      if (c.intercept_m > nearest_m && c.intercept_m < farthest_m) classes.right.push_back(c);
      if (c.intercept_m < -nearest_m && c.intercept_m > -farthest_m) classes.left.push_back(c);
    }
  }
  return classes;
}

std::optional<double> consensus_yaw(const LineClasses& classes) {
  constexpr double bandwidth_rad = 0.008;
  std::vector<std::pair<double, double>> weighted;  // slope, votes
  for (const auto* group : {&classes.across, &classes.down_ice}) {
    for (const ClassifiedLine& c : *group) weighted.emplace_back(c.slope_rad, c.line.votes);
  }
  if (weighted.empty()) return std::nullopt;
  const auto support = [&](double slope) {
    double sum = 0.0;
    for (const auto& [s, votes] : weighted) sum += votes * std::exp(-0.5 * std::pow((s - slope) / bandwidth_rad, 2));
    return sum;
  };
  const auto best = std::max_element(weighted.begin(), weighted.end(),
                                     [&](const auto& a, const auto& b) { return support(a.first) < support(b.first); });
  double mean = best->first;
  for (int i = 0; i < 10; ++i) {
    double sum = 0.0;
    double weight = 0.0;
    for (const auto& [s, votes] : weighted) {
      const double w = votes * std::exp(-0.5 * std::pow((s - mean) / bandwidth_rad, 2));
      sum += w * s;
      weight += w;
    }
    mean = sum / weight;
  }
  return -mean;
}

}  // namespace hogline::vision
