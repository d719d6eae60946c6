#include "servo/place_average.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hogline::servo::test {
namespace {

SheetPosePercept look(int number, double offset) {
  SheetPosePercept p;
  p.ok = true;
  p.stamp = Stamp(std::chrono::milliseconds(16 * number));
  p.body = {0.1 + offset, -3.0 + offset, 0.02 + offset};
  p.sigma = {0.003, 0.003, 0.003};
  p.hog_distance_m = 9.401 - offset;
  p.hog_distance_sigma_m = 0.003;
  return p;
}

TEST(PlaceAverage, AveragesAndKeepsTheSigmaOfOneLook) {
  PlaceAverage average;
  std::mt19937_64 random(1);
  for (int i = 0; i < 15; ++i) average.add(look(i, 0.002 * std::normal_distribution<double>()(random)));
  const auto place = average.average();
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->body.x_m, 0.1, 0.002);
  EXPECT_NEAR(place->hog_distance_m, 9.401, 0.002);
  EXPECT_GE(place->sigma.yaw_rad, 0.003) << "looks from one place share their errors";
  EXPECT_EQ(place->used, 15);
}

TEST(PlaceAverage, ThrowsOutliersOut) {
  PlaceAverage average;
  for (int i = 0; i < 12; ++i) average.add(look(i, 0.0));
  for (int i = 12; i < 16; ++i) average.add(look(i, 0.5));
  const auto place = average.average();
  EXPECT_NEAR(place->body.x_m, 0.1, 1e-12);
  EXPECT_EQ(place->used, 12);
  EXPECT_EQ(place->thrown_out, 4);
}

TEST(PlaceAverage, LooksThatSawNothingAndRepeatsDoNotCount) {
  PlaceAverage average;
  EXPECT_FALSE(average.average());
  SheetPosePercept blind;
  average.add(blind);
  average.add(look(1, 0.0));
  average.add(look(1, 0.0));
  EXPECT_EQ(average.size(), 1);
  average.clear();
  EXPECT_EQ(average.size(), 0);
}

}  // namespace
}  // namespace hogline::servo::test
