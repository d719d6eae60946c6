#include "vision/detect/line_classes.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <Eigen/LU>

#include "tests/vision/detect/sheet_view.hpp"

namespace hogline::vision {
namespace {

using testing::SheetView;

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

struct Count {
  std::size_t hog, left, right;
  bool operator==(const Count&) const = default;
};

Count count(const LineClasses& c) { return {c.hog.size(), c.left.size(), c.right.size()}; }

// Wherever the robot may stand, each of the three lines falls in its class and in no other of the three.
RC_GTEST_PROP(LineClasses, TheThreeLinesFallInTheirClasses, ()) {
  const SheetView sheet({uniform(-1.1, 1.1), uniform(-5.4, -1.6), uniform(-0.25, 0.25)});
  const double half_m = uniform(2.16, 2.5);
  const double hog = rules::tee_to_hog_m;
  const auto classes_of = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return count(classify({sheet.candidate(a, b)}, sheet.view, {}));
  };
  RC_ASSERT(classes_of({-1.5, hog}, {1.5, hog}) == (Count{1, 0, 0}));
  RC_ASSERT(classes_of({-half_m, 1.5}, {-half_m, 6.0}) == (Count{0, 1, 0}));
  RC_ASSERT(classes_of({half_m, 1.5}, {half_m, 6.0}) == (Count{0, 0, 1}));
}

RC_GTEST_PROP(LineClasses, SlopesAndInterceptsAreTheBodysPlace, ()) {
  const SheetView sheet({uniform(-1.1, 1.1), uniform(-5.4, -1.6), uniform(-0.25, 0.25)});
  const double hog = rules::tee_to_hog_m;
  const LineClasses classes =
      classify({sheet.candidate({-1.5, hog}, {1.5, hog}), sheet.candidate({2.3, 1.5}, {2.3, 6.0})}, sheet.view, {});
  RC_ASSERT(classes.hog.size() == 1U);
  RC_ASSERT(std::abs(classes.hog[0].slope_rad + sheet.body.yaw_rad) < 1e-6);
  RC_ASSERT(std::abs(classes.hog[0].intercept_m - (hog - sheet.body.y_m)) < 1e-6);
  RC_ASSERT(classes.right.size() == 1U);
  RC_ASSERT(std::abs(classes.right[0].slope_rad + sheet.body.yaw_rad) < 1e-6);
  RC_ASSERT(std::abs(classes.right[0].intercept_m - (2.3 - sheet.body.x_m)) < 1e-6);
}

TEST(LineClasses, WhatIsNoneOfTheThree) {
  const SheetView sheet({0.3, -3.5, 0.05});
  struct Case {
    const char* description;
    Eigen::Vector2d a, b;
  };
  const Case cases[] = {
      {"tee line", {-2.0, 0.0}, {-2.2, 0.0}},          {"back line", {-1.0, -1.829}, {1.0, -1.829}},
      {"centre line", {0.0, 2.0}, {0.0, 6.0}},         {"diagonal", {-1.5, 1.0}, {1.5, 5.0}},
      {"a wall beside", {4.9, 1.0}, {4.9, 8.0}},       {"a board across, far off", {-1.5, 10.5}, {1.5, 10.5}},
      {"too short to tell", {-2.3, 4.0}, {-2.3, 4.1}},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(count(classify({sheet.candidate(c.a, c.b)}, sheet.view, {})), (Count{0, 0, 0})) << c.description;
  }
}

TEST(ConsensusYaw, OutliersDoNotMoveIt) {
  const SheetView sheet({0.2, -3.4, 0.08});
  const LineClasses classes =
      classify({sheet.candidate({-1.5, 6.401}, {1.5, 6.401}, 120), sheet.candidate({-2.3, 1.0}, {-2.3, 6.0}, 150),
                sheet.candidate({0.0, 2.0}, {0.0, 6.0}, 100), sheet.candidate({1.2, 3.0}, {1.5, 6.0}, 140)},
               sheet.view, {});
  const auto yaw = consensus_yaw(classes);
  ASSERT_TRUE(yaw);
  EXPECT_NEAR(*yaw, 0.08, 0.002);
}

TEST(ConsensusYaw, NothingWithoutLines) { EXPECT_FALSE(consensus_yaw({})); }

}  // namespace
}  // namespace hogline::vision
