#include "vision/edges/profile.hpp"

#include <gtest/gtest.h>

#include "tests/vision/edges/drawn_edge.hpp"

namespace hogline::vision {
namespace {

using testing::draw;
using testing::DrawnEdge;

TEST(Sample, IsLinearLightWhateverTheResponse) {
  for (const double gamma : {1.0, 2.2}) {
    DrawnEdge even;
    even.gamma = gamma;
    even.paint = even.before = {0.25, 0.5, 0.75};
    const auto drawn = draw(even);
    Profile profile;
    ASSERT_TRUE(
        sample(drawn.picture(), ResponseCurve(gamma), {drawn.centre(), {0.6, 0.8}, -5.0, 5.0, 0.5, 1}, profile));
    EXPECT_EQ(profile.count, 21);
    EXPECT_EQ(profile.channels, 3);
    for (std::size_t i = 0; i < 21; ++i) {
      EXPECT_NEAR(static_cast<double>(profile.light[0][i]), 0.25, 0.006);
      EXPECT_NEAR(static_cast<double>(profile.light[2][i]), 0.75, 0.006);
    }
  }
}

struct Outside {
  const char* what;
  Cut cut;
};

TEST(Sample, RefusesWhatItCanNotCut) {
  const auto drawn = draw({});
  const Eigen::Vector2d right(1.0, 0.0);
  const Outside cases[] = {
      {"over the left border", {{3.0, 40.0}, right, -5.0, 5.0, 1.0, 0}},
      {"over the right border", {{92.0, 40.0}, right, -5.0, 5.0, 1.0, 0}},
      {"breadth over the top", {{40.0, 1.0}, right, -5.0, 5.0, 1.0, 2}},
      {"too many samples", {{48.0, 48.0}, right, -40.0, 40.0, 0.25, 0}},
      {"backwards", {{48.0, 48.0}, right, 5.0, -5.0, 1.0, 0}},
  };
  for (const Outside& c : cases) {
    Profile profile;
    profile.count = 7;
    EXPECT_FALSE(sample(drawn.picture(), ResponseCurve(1.0), c.cut, profile)) << c.what;
    EXPECT_EQ(profile.count, 0) << c.what;
  }
}

}  // namespace
}  // namespace hogline::vision
