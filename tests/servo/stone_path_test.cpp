#include "servo/stone_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace hogline::servo::test {
namespace {

struct Way {
  const char* name;
  SlidingStone start;
  IceFactors ice;
};

class StonePathOf : public testing::TestWithParam<Way> {};

TEST_P(StonePathOf, IsTheMotionReadAtAnyMoment) {
  const StonePath path(GetParam().start, GetParam().ice);
  const double whole_s = path.rest().after_s;
  for (double share = -0.05; share < 1.2; share += 0.0137) {
    const Slid mine = path.at(share * whole_s);
    const Slid motion = slide(GetParam().start, GetParam().ice, share * whole_s);
    EXPECT_NEAR(mine.stone.x_m, motion.stone.x_m, 1e-4) << share;
    EXPECT_NEAR(mine.stone.y_m, motion.stone.y_m, 1e-4) << share;
    EXPECT_NEAR(mine.stone.vy_mps, motion.stone.vy_mps, 1e-4) << share;
    EXPECT_LT((mine.by_start - motion.by_start).norm(), 2e-3 * (1.0 + motion.by_start.norm())) << share;
    EXPECT_EQ(mine.at_rest, share >= 1.0 || whole_s == 0.0);
  }
}

TEST_P(StonePathOf, EndsWhereTheMotionRests) {
  const StonePath path(GetParam().start, GetParam().ice);
  const Rest mine = path.rest();
  const Rest motion = rest_of(GetParam().start, GetParam().ice);
  EXPECT_NEAR(mine.x_m, motion.x_m, 1e-4);
  EXPECT_NEAR(mine.y_m, motion.y_m, 1e-4);
  EXPECT_NEAR(mine.after_s, motion.after_s, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Ways, StonePathOf,
                         testing::Values(Way{"draw", {0.0, 9.0, 0.02, 2.2, 1.6}, {1.05, 0.9, 2e-4}},
                                         Way{"towards_the_skip", {0.2, 28.4, -0.03, -2.1, -1.6}, {0.9, 0.7, -4e-4}},
                                         Way{"last_centimetre", {0.2, 1.0, 0.0, -0.06, -1.0}, {}},
                                         Way{"stands", {0.2, 1.0, 0.0, 0.0, 0.0}, {}}),
                         [](const auto& way) { return std::string(way.param.name); });

TEST(StonePath, CrossesALineWhenItIsThere) {
  const StonePath path({0.2, 28.4, -0.03, -2.1, -1.6}, {});
  const auto after_s = path.crossing_s(6.401);
  ASSERT_TRUE(after_s);
  EXPECT_NEAR(path.at(*after_s).stone.y_m, 6.401, 1e-6);
}

TEST(StonePath, NeverCrossesWhatItDoesNotReach) {
  const StonePath path({0.2, 28.4, -0.03, -1.5, -1.6}, {});
  EXPECT_FALSE(path.crossing_s(-1.829));
  EXPECT_FALSE(path.crossing_s(30.0));
}

TEST(StonePath, BeginsOnTheLineItStartsFrom) {
  EXPECT_EQ(StonePath({0.2, 28.4, -0.03, -1.5, -1.6}, {}).crossing_s(28.4), 0.0);
}

}  // namespace
}  // namespace hogline::servo::test
