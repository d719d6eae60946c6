#include "vision/edges/candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vision/edges/drawn_edge.hpp"

namespace hogline::vision {
namespace {

using testing::draw;
using testing::DrawnEdge;

Profile wide_cut(const DrawnEdge& edge) {
  const auto drawn = draw(edge);
  Profile profile;
  EXPECT_TRUE(
      sample(drawn.picture(), ResponseCurve(1.0), {drawn.centre(), drawn.normal, -30.0, 30.0, 1.0, 1}, profile));
  return profile;
}

TEST(FindSteps, FindsAStepAnywhereToAboutAPixel) {
  for (const double at : {-20.0, -7.3, 0.0, 12.6}) {
    DrawnEdge edge;
    edge.offset_px = at;
    edge.angle_deg = 20.0;
    edge.noise = 0.02;
    const Candidates found = find_steps(wide_cut(edge), 1.0);
    ASSERT_GE(found.count, 1);
    EXPECT_NEAR(found.at[0].offset_px, at, 0.8);
  }
}

TEST(FindRidges, FindsALineButNotAStep) {
  DrawnEdge line;
  line.width_px = 3.0;
  line.offset_px = 9.4;
  line.noise = 0.02;
  const Candidates found = find_ridges(wide_cut(line), 3.0, 1.0);
  ASSERT_GE(found.count, 1);
  EXPECT_NEAR(found.at[0].offset_px, 9.4, 0.8);

  DrawnEdge step;
  step.noise = 0.005;
  for (const Candidate& c : find_ridges(wide_cut(step), 3.0, 1.0).list()) EXPECT_LT(c.strength, 0.1);
}

TEST(Candidates, AreFewInNoiseAndStrongestFirst) {
  int ghosts = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    DrawnEdge noise;
    noise.paint = noise.before;
    noise.noise = 0.03;
    noise.seed = seed;
    const Candidates found = find_steps(wide_cut(noise), 1.0);
    ghosts += found.count;
    for (int i = 1; i < found.count; ++i) {
      EXPECT_LE(found.at[static_cast<std::size_t>(i)].strength, found.at[static_cast<std::size_t>(i - 1)].strength);
    }
  }
  EXPECT_LT(ghosts, 100);  // two a profile of 61 samples: the joint fit is robust against those
}

}  // namespace
}  // namespace hogline::vision
