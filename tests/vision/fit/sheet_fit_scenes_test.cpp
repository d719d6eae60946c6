// The joint fit on rendered scenes with exact truth, from starts that are wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/vision/scene.hpp"
#include "vision/fit/sheet_fit.hpp"

namespace hogline::vision {
namespace {

using testing::load_scene;
using testing::Scene;

constexpr double deg = std::numbers::pi / 180.0;

SheetFitStart start_near(const Scene& scene, unsigned seed, double off) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  PlanarPose body = scene.body;
  body.x_m += 0.05 * off * normal(generator);
  body.y_m += 0.05 * off * normal(generator);
  body.yaw_rad += 0.6 * deg * off * normal(generator);
  SheetFitStart start;
  start.eMc = eMb(body) * bMc(scene.setup.mount);
  start.search_px = 24.0;
  start.roll_sigma_rad = start.pitch_sigma_rad = 0.5 * deg;
  start.height_sigma_m = 0.01;
  return start;
}

class NearScenes : public ::testing::TestWithParam<const char*> {};

TEST_P(NearScenes, AreFittedToMillimetresFromAWrongStart) {
  const Scene scene = load_scene(GetParam());
  SheetFit fit(scene.setup);
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SheetFitResult& result = fit.fit(scene.image, start_near(scene, seed, 1.0));
    ASSERT_TRUE(result.ok) << result.reason;
    EXPECT_NEAR(result.body.yaw_rad / deg, scene.body.yaw_rad / deg, 0.015);
    EXPECT_NEAR(result.body.x_m, scene.body.x_m, 0.003);
    EXPECT_NEAR(result.body.y_m, scene.body.y_m, 0.003);
    EXPECT_LT(std::abs(result.body.yaw_rad - scene.body.yaw_rad), 4.0 * result.sigma.yaw_rad);
    EXPECT_LT(result.residual_px, 0.4);
    EXPECT_EQ(result.sheet_width_m.has_value(), scene.sideline != "none");
    EXPECT_NEAR(result.sheet_width_m.value_or(scene.sheet_width_m), scene.sheet_width_m, 0.015);
  }
}

TEST_P(NearScenes, StandAWrongDepthOfThePaintWhenItIsEstimated) {
  Scene scene = load_scene(GetParam());
  scene.setup.ice.paint_depth_m = 0.006;
  SheetFit fit(scene.setup);
  SheetFitStart start = start_near(scene, 4, 0.5);
  start.paint_depth_sigma_m = 0.004;
  const SheetFitResult& result = fit.fit(scene.image, start);
  ASSERT_TRUE(result.ok) << result.reason;
  EXPECT_NEAR(result.body.yaw_rad / deg, scene.body.yaw_rad / deg, 0.02);
  EXPECT_NEAR(result.body.x_m, scene.body.x_m, 0.01);
  EXPECT_NEAR(result.body.y_m, scene.body.y_m, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Scenes, NearScenes,
                         ::testing::Values("near/near-11-000", "near/near-11-003", "near/near-11-009",
                                           "skip/skip-12-002"));

struct LowCase {
  const char* name;
  double hog_m;  ///< wanted of the distance
};

class LowScenes : public ::testing::TestWithParam<LowCase> {};

TEST_P(LowScenes, TellTheDistanceToTheHogLine) {
  const Scene scene = load_scene(GetParam().name);
  SheetFit fit(scene.setup);
  for (const unsigned seed : {1U, 2U}) {
    SheetFitStart start = start_near(scene, seed, 0.3);
    start.sheet_width_m = scene.sheet_width_m;
    const SheetFitResult& result = fit.fit(scene.image, start);
    ASSERT_TRUE(result.ok) << result.reason;
    EXPECT_NEAR(result.body.y_m, scene.body.y_m, GetParam().hog_m);
    EXPECT_NEAR(result.body.yaw_rad / deg, scene.body.yaw_rad / deg, 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LowScenes,
                         ::testing::Values(LowCase{"low/low-13-006", 0.005}, LowCase{"low/low-13-007", 0.030}));

}  // namespace
}  // namespace hogline::vision
