// Where moving edges lead: bias at the angles that trip ViSP's own sites, both ways, around the end of the search.
#include "vision/edges/moving_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/vision/edges/drawn_edge.hpp"

namespace hogline::vision {
namespace {

using testing::draw;
using testing::DrawnEdge;
using testing::DrawnPicture;

constexpr double angles_deg[] = {0.0, 1.0, 45.0, 89.0, 90.0, 179.0, 180.0, 271.0};

MovingEdge expected_at(const DrawnPicture& drawn, double offset_px, int range_px) {
  MovingEdge edge;
  edge.pixel = drawn.centre() + offset_px * drawn.normal;
  edge.normal = drawn.normal;
  edge.range_px = range_px;
  return edge;
}

struct Kind {
  const char* what;
  double width_px;  // below 0: an edge
  double blur_px;
};

class Moved : public ::testing::TestWithParam<Kind> {
 protected:
  static DrawnEdge drawn_edge(double angle_deg, double offset_px) {
    DrawnEdge edge;
    edge.angle_deg = angle_deg;
    edge.offset_px = offset_px;
    edge.width_px = std::max(GetParam().width_px, 0.0);
    edge.blur_px = GetParam().blur_px;
    return edge;
  }
};

// ViSP's sites are off by 0.02 px one way and 0.98 px the other at 0 degrees: here neither way is preferred.
TEST_P(Moved, IsFoundWithoutBiasAtAnyAngleAndBothWays) {
  const MovingEdges edges;
  for (const double angle_deg : angles_deg) {
    std::array<double, 2> sum{};
    int n = 0;
    for (double phase = -0.4; phase < 0.5; phase += 0.2) {
      const DrawnPicture drawn = draw(drawn_edge(angle_deg, phase));
      for (double jump = 0.0; jump < 4.0; jump += 0.1, ++n) {
        for (std::size_t way = 0; way < 2; ++way) {
          const double moved_px = way == 0 ? jump : -jump;
          MovingEdge edge = expected_at(drawn, phase - moved_px, 6);
          edge.width_px = GetParam().width_px;
          const MovedEdge moved = edges.follow(drawn.picture(), edge);
          ASSERT_TRUE(moved.found) << "angle " << angle_deg << " moved by " << moved_px;
          EXPECT_NEAR(moved.offset_px, moved_px, 1.01) << "angle " << angle_deg;
          sum[way] += moved.offset_px - moved_px;
        }
      }
    }
    for (const double bias : sum) EXPECT_NEAR(bias / n, 0.0, 0.2) << "angle " << angle_deg;
  }
}

TEST_P(Moved, IsFoundUpToTheEndOfTheSearchAndNotBeyond) {
  const MovingEdges edges;
  for (const double angle_deg : angles_deg) {
    const DrawnPicture drawn = draw(drawn_edge(angle_deg, 0.0));
    for (const int range_px : {2, 6, 12}) {
      for (const double way : {-1.0, 1.0}) {
        MovingEdge edge = expected_at(drawn, -way * (range_px - 0.5), range_px);
        edge.width_px = GetParam().width_px;
        const MovedEdge found = edges.follow(drawn.picture(), edge);
        EXPECT_TRUE(found.found) << "angle " << angle_deg << " range " << range_px;
        EXPECT_NEAR(found.offset_px, way * (range_px - 0.5), 1.01);

        edge.pixel = drawn.centre() - way * (range_px + 8.0) * drawn.normal;
        EXPECT_FALSE(edges.follow(drawn.picture(), edge).found) << "angle " << angle_deg << " range " << range_px;
      }
    }
  }
}

TEST_P(Moved, IsNotFoundWhereItIsHidden) {
  const MovingEdges edges;
  DrawnEdge hidden = drawn_edge(30.0, 0.0);
  hidden.paint = hidden.before;
  hidden.noise = 0.01;
  for (unsigned seed = 0; seed < 20; ++seed) {
    hidden.seed = seed;
    const DrawnPicture drawn = draw(hidden);
    MovingEdge edge = expected_at(drawn, 0.0, 8);
    edge.width_px = GetParam().width_px;
    EXPECT_FALSE(edges.follow(drawn.picture(), edge).found) << "noise taken for an edge, seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Moved,
                         ::testing::Values(Kind{"sharp edge", -1.0, 0.6}, Kind{"edge", -1.0, 1.0},
                                           Kind{"blurred edge", -1.0, 2.0}, Kind{"thin line", 1.6, 0.8},
                                           Kind{"line", 4.0, 1.0}, Kind{"wide line", 9.0, 1.0}),
                         [](const auto& row) {
                           std::string name = row.param.what;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST(MovingEdges, KnowTheWayTheContrastGoes) {
  const MovingEdges edges;
  DrawnEdge darker;
  darker.angle_deg = 20.0;
  darker.blur_px = 0.4;
  DrawnEdge brighter = darker;
  std::swap(brighter.before, brighter.paint);
  // 153 grey levels, less what blur takes from a mask of five pixels.
  const DrawnPicture down = draw(darker);
  const DrawnPicture up = draw(brighter);
  EXPECT_NEAR(edges.follow(down.picture(), expected_at(down, 0.0, 3)).contrast, -130.0, 25.0);
  EXPECT_NEAR(edges.follow(up.picture(), expected_at(up, 0.0, 3)).contrast, 130.0, 25.0);
}

TEST(MovingEdges, PreferWhatLooksLikeWhatWasSeenBefore) {
  // A bar shows two edges of opposite sense: memory tells which one is meant, though the other is as near.
  const MovingEdges edges;
  DrawnEdge bar;
  bar.angle_deg = 70.0;
  bar.width_px = 8.0;
  const DrawnPicture drawn = draw(bar);
  for (const double sense : {-1.0, 1.0}) {
    MovingEdge edge = expected_at(drawn, 0.0, 8);
    edge.contrast = sense * 150.0;
    const MovedEdge moved = edges.follow(drawn.picture(), edge);
    ASSERT_TRUE(moved.found);
    EXPECT_NEAR(moved.offset_px, sense * 4.0, 1.01);
  }
  MovingEdge fainter = expected_at(drawn, 0.0, 8);
  fainter.contrast = 40.0;
  EXPECT_FALSE(edges.follow(drawn.picture(), fainter).found) << "an edge four times as strong is another one";
}

TEST(MovingEdges, SeeColoursThatAreEquallyBrightByTheirOwnContrast) {
  const MovingEdges edges;
  DrawnEdge edge;
  edge.angle_deg = 135.0;
  edge.offset_px = 1.4;
  edge.before = {0.2, 0.4, 0.6};
  edge.paint = {0.6, 0.4, 0.2};
  const DrawnPicture drawn = draw(edge);
  MovingEdge site = expected_at(drawn, 0.0, 5);
  EXPECT_FALSE(edges.follow(drawn.picture(), site).found) << "their grey is the same";
  site.colour = {0.7F, 0.0F, -0.7F};
  const MovedEdge moved = edges.follow(drawn.picture(), site);
  ASSERT_TRUE(moved.found);
  EXPECT_NEAR(moved.offset_px, 1.4, 1.01);
  EXPECT_GT(moved.contrast, 0.0);
}

TEST(MovingEdges, AreNotLookedForBeyondThePicturesBorder) {
  const MovingEdges edges;
  const DrawnPicture drawn = draw({});
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(2.0, 48.0), Eigen::Vector2d(48.0, 95.0),
                                       Eigen::Vector2d(-50.0, -50.0), Eigen::Vector2d(1e9, 48.0)}) {
    MovingEdge edge;
    edge.pixel = pixel;
    edge.normal = {1.0, 0.0};
    EXPECT_FALSE(edges.follow(drawn.picture(), edge).found);
  }
}

}  // namespace
}  // namespace hogline::vision
