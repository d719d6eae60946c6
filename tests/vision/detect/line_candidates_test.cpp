#include "vision/detect/line_candidates.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <random>

#include "tests/vision/detect/sheet_view.hpp"

namespace hogline::vision {
namespace {

using testing::SheetView;

// Both edges of a painted line between two points, `step_m` apart along it.
void paint_line(const SheetView& sheet, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width_m,
                std::vector<EdgePoint>& points) {
  const Eigen::Vector2d along = (b - a).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  for (double t = 0.0; t < (b - a).norm(); t += 0.02) {
    const Eigen::Vector2d p = a + t * along;
    points.push_back(sheet.edge(p + 0.5 * width_m * across, across));
    points.push_back(sheet.edge(p - 0.5 * width_m * across, -across));
  }
}

// How far a candidate is from the true middle of a painted line, at its two ends, in pixels.
double distance_px(const SheetView& sheet, const LineCandidate& c, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double at_a = std::abs(c.normal.dot(sheet.plane(a.x(), a.y())) - c.rho);
  const double at_b = std::abs(c.normal.dot(sheet.plane(b.x(), b.y())) - c.rho);
  return 780.0 * std::max(at_a, at_b);
}

double closest_px(const SheetView& sheet, const std::vector<LineCandidate>& lines, const Eigen::Vector2d& a,
                  const Eigen::Vector2d& b) {
  double best = 1e9;
  for (const LineCandidate& c : lines) best = std::min(best, distance_px(sheet, c, a, b));
  return best;
}

TEST(LineCandidates, ThinLinesAreFoundAtTheirMiddleAmongClutter) {
  for (const double yaw : {-0.25, -0.1, 0.0, 0.1, 0.25}) {
    const SheetView sheet({0.3, -3.5, yaw});
    std::vector<EdgePoint> points;
    paint_line(sheet, {-1.5, 6.45}, {1.5, 6.45}, 0.1, points);
    paint_line(sheet, {-2.2, 1.5}, {-2.2, 6.0}, 0.02, points);
    paint_line(sheet, {0.0, 2.0}, {0.0, 6.0}, 0.0127, points);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
      const double angle = 6.28 * unit(random);
      points.push_back(sheet.edge({4.0 * unit(random) - 2.0, 7.0 * unit(random)}, {std::cos(angle), std::sin(angle)}));
    }
    const auto lines = find_line_candidates(points, 780.0, 60);
    EXPECT_LT(closest_px(sheet, lines, {-1.5, 6.45}, {1.5, 6.45}), 1.0) << "hog line, yaw " << yaw;
    EXPECT_LT(closest_px(sheet, lines, {-2.2, 1.5}, {-2.2, 6.0}), 1.0) << "sideline, yaw " << yaw;
    EXPECT_LT(closest_px(sheet, lines, {0.0, 2.0}, {0.0, 6.0}), 1.0) << "centre line, yaw " << yaw;
  }
}

TEST(LineCandidates, StrongestFirstAndNoMoreThanAskedFor) {
  const SheetView sheet({0.0, -3.5, 0.0});
  std::vector<EdgePoint> points;
  for (double x = -2.0; x <= 2.0; x += 0.5) paint_line(sheet, {x, 2.0}, {x, 4.0 + x}, 0.02, points);
  const auto lines = find_line_candidates(points, 780.0, 3);
  ASSERT_LE(lines.size(), 3U);
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(
      std::is_sorted(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.votes > b.votes; }));
}

TEST(LineCandidates, NoneFromNoPoints) { EXPECT_TRUE(find_line_candidates({}, 780.0, 60).empty()); }

}  // namespace
}  // namespace hogline::vision
