#include "vision/detect/four_points.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <Eigen/LU>

#include "tests/vision/detect/sheet_view.hpp"

namespace hogline::vision {
namespace {

using testing::SheetView;

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

PlanarPose a_body() { return {uniform(-1.2, 1.2), uniform(-5.5, -2.0), uniform(-0.26, 0.26)}; }

RC_GTEST_PROP(FourPoints, AreTheRingsEndsOnTeeLineAndCentreLine, ()) {
  const SheetView sheet(a_body());
  const double hog_y_m = rules::tee_to_hog_m;
  const double half_m = uniform(2.16, 2.5);
  const auto four = four_points(sheet.ring(), sheet.line({-1.0, hog_y_m}, {1.0, hog_y_m}),
                                sheet.line({-half_m, 1.0}, {-half_m, 6.0}), sheet.line({half_m, 1.0}, {half_m, 6.0}));
  RC_ASSERT(four.has_value());
  const double R = rules::outer_ring_radius_m;
  const std::array<Eigen::Vector2d, 4> expected{{{R, 0.0}, {-R, 0.0}, {0.0, R}, {0.0, -R}}};
  for (std::size_t i = 0; i < 4; ++i) {
    RC_ASSERT((four->sheet[i] - expected[i]).norm() < 1e-12);
    RC_ASSERT((four->plane[i] - sheet.plane(expected[i].x(), expected[i].y())).norm() < 1e-9);
  }
}

// The sheet's width does not matter: sidelines only give the direction.
RC_GTEST_PROP(FourPoints, DoNotDependOnTheSidelinesSpacing, ()) {
  const SheetView sheet(a_body());
  const Eigen::Vector3d hog = sheet.line({-1.0, rules::tee_to_hog_m}, {1.0, rules::tee_to_hog_m});
  const auto at = [&](double left, double right) {
    return four_points(sheet.ring(), hog, sheet.line({left, 1.0}, {left, 6.0}), sheet.line({right, 1.0}, {right, 6.0}));
  };
  const auto a = at(-2.3, 2.3);
  const auto b = at(-uniform(1.0, 4.0), uniform(0.0, 4.0));
  RC_ASSERT(a && b);
  for (std::size_t i = 0; i < 4; ++i) RC_ASSERT((a->plane[i] - b->plane[i]).norm() < 1e-8);
}

TEST(FourPoints, NothingWhenAVanishingPointLiesInTheRing) {
  const SheetView sheet({0.0, -3.5, 0.0});
  const Eigen::Vector3d hog = sheet.line({-1.0, 6.401}, {1.0, 6.401});
  const Eigen::Vector3d through_tee_a = sheet.line({0.0, 0.0}, {1.0, 1.0});
  const Eigen::Vector3d through_tee_b = sheet.line({0.0, 0.0}, {-1.0, 1.0});
  EXPECT_FALSE(four_points(sheet.ring(), hog, through_tee_a, through_tee_b));
}

TEST(FourPoints, NothingForALineTwice) {
  const SheetView sheet({0.0, -3.5, 0.0});
  const Eigen::Vector3d left = sheet.line({-2.3, 1.0}, {-2.3, 6.0});
  EXPECT_FALSE(four_points(sheet.ring(), sheet.line({-1.0, 6.401}, {1.0, 6.401}), left, left));
}

}  // namespace
}  // namespace hogline::vision
