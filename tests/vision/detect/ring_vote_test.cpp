#include "vision/detect/ring_vote.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>
#include <random>

#include "tests/vision/detect/sheet_view.hpp"

namespace hogline::vision {
namespace {

using testing::SheetView;

// Edge points of the three rings about `centre` in e, between two angles.
void paint_rings(const SheetView& sheet, const Eigen::Vector2d& centre, double from, double to,
                 std::vector<EdgePoint>& points) {
  const std::array<std::pair<double, double>, 3> rings{
      {{rules::outer_ring_radius_m, 1.0}, {rules::middle_ring_radius_m, -1.0}, {rules::inner_ring_radius_m, 1.0}}};
  for (const auto& [radius_m, ice_side] : rings) {
    for (double a = from; a < to; a += 0.02) {
      const Eigen::Vector2d u(std::cos(a), std::sin(a));
      points.push_back(sheet.edge(centre + radius_m * u, ice_side * u));
    }
  }
}

Eigen::Vector2d true_centre(const SheetView& sheet) { return sheet.edge({0.0, 0.0}, {0.0, 1.0}).ground; }

TEST(RingVote, FindsTheTeeFromWholeCutAndHiddenRings) {
  constexpr double pi = std::numbers::pi;
  struct Case {
    const char* description;
    PlanarPose body;
    double from, to;
  };
  const Case cases[] = {
      {"whole, straight ahead", {0.0, -3.5, 0.0}, 0.0, 2.0 * pi},
      {"whole, aside and turned", {1.0, -4.8, 0.2}, 0.0, 2.0 * pi},
      {"far half", {0.3, -2.0, -0.1}, 0.0, pi},
      {"left half", {-0.5, -3.0, 0.1}, pi / 2.0, 3.0 * pi / 2.0},
      {"a third", {0.2, -3.5, 0.0}, 0.5, 0.5 + 2.0 * pi / 3.0},
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Case& c : cases) {
    const SheetView sheet(c.body);
    std::vector<EdgePoint> points;
    paint_rings(sheet, {0.0, 0.0}, c.from, c.to, points);
    for (int i = 0; i < 500; ++i) {
      const double angle = 2.0 * pi * unit(random);
      points.push_back(sheet.edge({5.0 * unit(random) - 2.5, 7.0 * unit(random)}, {std::cos(angle), std::sin(angle)}));
    }
    const auto vote = vote_for_house(points, {});
    ASSERT_TRUE(vote) << c.description;
    EXPECT_LT((vote->centre - true_centre(sheet)).norm(), 0.02) << c.description;
  }
}

TEST(RingVote, NothingWhereThereAreNoRings) {
  const SheetView sheet({0.0, -3.5, 0.0});
  EXPECT_FALSE(vote_for_house({}, {}));
  std::vector<EdgePoint> line;
  for (double y = -1.0; y < 6.0; y += 0.05) line.push_back(sheet.edge({1.0, y}, {1.0, 0.0}));
  EXPECT_FALSE(vote_for_house(line, {}));
}

}  // namespace
}  // namespace hogline::vision
