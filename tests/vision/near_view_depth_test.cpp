// What it buys and costs to estimate the paint's depth under the ice, with a prior, instead of taking it as given.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/random_scene.hpp"
#include "vision/near_view.hpp"

namespace hogline::vision {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr int scenes = 6;

struct Errors {
  double yaw_deg = 0.0;  // RMS
  double y_mm = 0.0;
  double y_in_sigmas = 0.0;
  double y_sigma_mm = 0.0;
};

Errors errors(double true_depth_m, double depth_sigma_m) {
  Errors sum;
  for (std::uint64_t seed = 3000; seed < 3000 + scenes; ++seed) {
    hogline::testing::RandomScene scene = hogline::testing::random_scene(seed);
    scene.setup.ice.paint_depth_m = true_depth_m;
    const cv::Mat picture = hogline::testing::render(scene);
    scene.setup.ice.paint_depth_m = 0.006;
    scene.setup.paint_depth_sigma_m = depth_sigma_m;
    const SheetPosePercept p = NearView(scene.setup).acquire(picture, {});
    EXPECT_TRUE(p.ok) << p.reason << "; " << scene.what;
    const double y_m = p.body.y_m - scene.body.y_m;
    sum.yaw_deg += std::pow((p.body.yaw_rad - scene.body.yaw_rad) / degree, 2) / scenes;
    sum.y_mm += std::pow(1000.0 * y_m, 2) / scenes;
    sum.y_in_sigmas += std::pow(y_m / p.sigma.y_m, 2) / scenes;
    sum.y_sigma_mm += 1000.0 * p.sigma.y_m / scenes;
  }
  return {std::sqrt(sum.yaw_deg), std::sqrt(sum.y_mm), std::sqrt(sum.y_in_sigmas), sum.y_sigma_mm};
}

TEST(NearViewDepth, IsMeasuredWhereTheRigIsNotSureOfIt) {
  const Errors given = errors(0.012, 0.0);
  const Errors estimated = errors(0.012, 0.003);
  RecordProperty("given_y_mm", std::to_string(given.y_mm));
  RecordProperty("estimated_y_mm", std::to_string(estimated.y_mm));
  EXPECT_LT(given.yaw_deg, 0.02) << "depth hardly turns the sheet";
  EXPECT_LT(given.y_mm, 10.0);
  EXPECT_LT(estimated.yaw_deg, 0.005);
  EXPECT_LT(estimated.y_mm, 0.7 * given.y_mm);
  EXPECT_LT(estimated.y_in_sigmas, given.y_in_sigmas) << "and its sigma knows";
}

TEST(NearViewDepth, CostsLittleWhereTheRigWasRight) {
  const Errors given = errors(0.006, 0.0);
  const Errors estimated = errors(0.006, 0.003);
  RecordProperty("given_y_mm", std::to_string(given.y_mm));
  RecordProperty("estimated_y_mm", std::to_string(estimated.y_mm));
  EXPECT_LT(estimated.y_mm, 1.0);
  EXPECT_LT(estimated.yaw_deg, 0.005);
  EXPECT_GE(estimated.y_sigma_mm, 0.99 * given.y_sigma_mm) << "one unknown more can not make surer";
}

}  // namespace
}  // namespace hogline::vision
