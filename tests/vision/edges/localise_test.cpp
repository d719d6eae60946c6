// Bias and spread of subpixel places, against edges drawn where they are known to be and against the Cramer-Rao bound.
#include "vision/edges/localise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vision/edges/drawn_edge.hpp"

namespace hogline::vision {
namespace {

using testing::draw;
using testing::DrawnEdge;

constexpr int half_breadth = 2;

LocalEdge find(const DrawnEdge& edge, double expected_blur_px) {
  const auto drawn = draw(edge);
  const double room = 3.0 * edge.blur_px + 3.0;
  const double reach = 0.5 * edge.width_px + room + 1.0;
  Profile profile;
  const ResponseCurve response(edge.gamma);
  EXPECT_TRUE(
      sample(drawn.picture(), response, {drawn.centre(), drawn.normal, -reach, reach, 0.5, half_breadth}, profile));
  return locate(profile, {0.0, edge.width_px, expected_blur_px, room, room, 2.0});
}

struct Shape {
  const char* what;
  double width_px;
  double blur_px;
};

class Bias : public ::testing::TestWithParam<Shape> {};

TEST_P(Bias, IsAHundredthOfAPixelAtAnyAngleGammaAndPhase) {
  for (const double angle_deg : {0.0, 1.0, 45.0, 89.0, 90.0, 179.0}) {
    for (const double gamma : {1.0, 2.2}) {
      double sum = 0.0;
      int n = 0;
      for (double phase = -0.45; phase < 0.5; phase += 0.1, ++n) {
        DrawnEdge edge;
        edge.angle_deg = angle_deg;
        edge.offset_px = phase;
        edge.width_px = GetParam().width_px;
        edge.blur_px = GetParam().blur_px;
        edge.gamma = gamma;
        const LocalEdge found = find(edge, GetParam().blur_px);
        ASSERT_TRUE(found.ok()) << GetParam().what << " angle " << angle_deg << " gamma " << gamma;
        EXPECT_NEAR(found.offset_px, phase, 0.04) << GetParam().what << " angle " << angle_deg << " gamma " << gamma;
        sum += found.offset_px - phase;
      }
      // A level of eight bits is 0.016 px of an edge for each pixel of blur: its rounding does not average out.
      EXPECT_NEAR(sum / n, 0.0, 0.01 + 0.002 * GetParam().blur_px)
          << GetParam().what << " angle " << angle_deg << " gamma " << gamma;
    }
  }
}

TEST_P(Bias, DoesNotComeFromAWronglyExpectedBlur) {
  for (const double factor : {0.6, 1.6}) {
    DrawnEdge edge;
    edge.angle_deg = 30.0;
    edge.offset_px = 0.3;
    edge.width_px = GetParam().width_px;
    edge.blur_px = GetParam().blur_px;
    const LocalEdge found = find(edge, factor * GetParam().blur_px);
    ASSERT_TRUE(found.ok());
    EXPECT_NEAR(found.offset_px, 0.3, 0.03) << GetParam().what << " expected blur times " << factor;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Bias,
                         ::testing::Values(Shape{"sharp step", 0.0, 0.6}, Shape{"usual step", 0.0, 1.0},
                                           Shape{"blurred step", 0.0, 3.0}, Shape{"smeared step", 0.0, 8.0},
                                           Shape{"hair line", 0.8, 1.0}, Shape{"thin line", 1.6, 1.0},
                                           Shape{"line", 5.0, 1.0}, Shape{"blurred line", 5.0, 3.0}));

struct Noisy {
  const char* what;
  double blur_px;
  double noise;
  double contrast;
};

class Spread : public ::testing::TestWithParam<Noisy> {};

// The bound of one profile of independent samples a pixel apart; five of them side by side are averaged.
TEST_P(Spread, IsNearTheCramerRaoBoundAndHonestlyStated) {
  const Noisy& p = GetParam();
  constexpr int trials = 150;
  double sum = 0.0;
  double sum2 = 0.0;
  double stated2 = 0.0;
  for (unsigned seed = 1; seed <= trials; ++seed) {
    DrawnEdge edge;
    edge.blur_px = p.blur_px;
    edge.noise = p.noise;
    edge.seed = seed;
    edge.paint.fill(0.7 - p.contrast);
    edge.before.fill(0.7);
    const LocalEdge found = find(edge, p.blur_px);
    ASSERT_TRUE(found.ok()) << p.what;
    sum += found.offset_px;
    sum2 += found.offset_px * found.offset_px;
    stated2 += found.sigma_px * found.sigma_px;
  }
  const double mean = sum / trials;
  const double spread = std::sqrt(sum2 / trials - mean * mean);
  const double joined_noise = p.noise / std::sqrt(3.0 * (2 * half_breadth + 1));  // three channels of equal contrast
  const double bound = joined_noise * std::sqrt(2.0 * std::sqrt(std::numbers::pi) * p.blur_px) / p.contrast;
  EXPECT_LT(spread, 2.0 * bound) << p.what;
  EXPECT_LT(std::abs(mean), 4.0 * spread / std::sqrt(trials)) << p.what;
  EXPECT_NEAR(std::sqrt(stated2 / trials) / spread, 1.0, 0.4) << p.what;
}

INSTANTIATE_TEST_SUITE_P(Noise, Spread,
                         ::testing::Values(Noisy{"clear", 1.0, 0.02, 0.6}, Noisy{"pale", 1.0, 0.02, 0.15},
                                           Noisy{"blurred", 4.0, 0.02, 0.6}));

TEST(Locate, FindsPaintThatOnlyDiffersInColour) {
  DrawnEdge edge;
  edge.before = {0.5, 0.2, 0.2};  // as bright as the paint in the mean of its channels
  edge.paint = {0.2, 0.2, 0.5};
  edge.offset_px = 0.25;
  edge.noise = 0.01;
  const LocalEdge found = find(edge, 1.0);
  ASSERT_TRUE(found.ok());
  EXPECT_NEAR(found.offset_px, 0.25, 0.05);
  EXPECT_LT(found.colour[0], -0.6F);
  EXPECT_GT(found.colour[2], 0.6F);
}

TEST(Locate, ReportsContrastAndBlur) {
  DrawnEdge edge;
  edge.blur_px = 2.0;
  const LocalEdge found = find(edge, 1.5);
  ASSERT_TRUE(found.ok());
  EXPECT_NEAR(found.blur_px, 2.0, 0.15);
  EXPECT_NEAR(found.contrast, 0.6 * std::sqrt(3.0), 0.05);
}

TEST(Locate, SaysWhyItFoundNothing) {
  DrawnEdge flat;
  flat.paint = flat.before;
  flat.noise = 0.02;
  int ghosts = 0;
  for (flat.seed = 1; flat.seed <= 100; ++flat.seed) {
    const LocalEdge ghost = find(flat, 1.0);
    if (!ghost.ok()) continue;
    ++ghosts;
    EXPECT_GT(ghost.sigma_px, 0.2);
  }
  EXPECT_LE(ghosts, 5);

  DrawnEdge away;
  away.offset_px = 3.5;
  EXPECT_FALSE(find(away, 1.0).ok());

  EXPECT_EQ(locate(Profile{}, {}).fault, EdgeFault::too_short);
}

}  // namespace
}  // namespace hogline::vision
