// Paint that is hidden is not missing: a third of the picture covered, and the rest fits.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/support/random_scene.hpp"
#include "vision/near_view.hpp"

namespace hogline::vision {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Cover {
  const char* description;
  cv::Rect area;
};

void PrintTo(const Cover& c, std::ostream* out) { *out << c.description; }

class NearViewBehindCovers : public ::testing::TestWithParam<Cover> {};

// Flat grey, nearly as bright as ice: no colour and no roughness tells it.
TEST_P(NearViewBehindCovers, SeesBesideThem) {
  constexpr int scenes = 4;
  int seen = 0;
  for (std::uint64_t seed = 4000; seed < 4000 + scenes; ++seed) {
    const hogline::testing::RandomScene scene = hogline::testing::random_scene(seed);
    cv::Mat picture = hogline::testing::render(scene);
    cv::rectangle(picture, GetParam().area, cv::Scalar::all(120), cv::FILLED);
    const SheetPosePercept p = NearView(scene.setup).acquire(picture, {});
    if (!p.ok) continue;
    ++seen;
    EXPECT_NEAR(p.body.yaw_rad, scene.body.yaw_rad, 0.03 * degree) << scene.what;
    EXPECT_NEAR(p.body.x_m, scene.body.x_m, 0.004) << scene.what;
    EXPECT_NEAR(p.body.y_m, scene.body.y_m, 0.005) << scene.what;
  }
  EXPECT_GE(seen, scenes - 1);
}

INSTANTIATE_TEST_SUITE_P(Covers, NearViewBehindCovers,
                         ::testing::Values(Cover{"the left third", {0, 0, 533, 1200}},
                                           Cover{"the right third", {1067, 0, 533, 1200}},
                                           Cover{"the upper third", {0, 0, 1600, 400}},
                                           Cover{"a quarter in the middle", {633, 0, 400, 1200}}));

}  // namespace
}  // namespace hogline::vision
