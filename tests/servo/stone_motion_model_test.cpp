#include "servo/stone_motion_model.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>

#include "hw/sim/stone_motion.hpp"

namespace hogline::servo::test {
namespace {

constexpr double hog_to_hog_m = 21.945;
constexpr double near_hog_m = 10.059;
constexpr double far_tee_m = 38.405;

SlidingStone thrown(double speed_mps, double spin_radps) { return {0.0, near_hog_m, 0.0, speed_mps, spin_radps}; }

/// When the stone has gone this far down-ice.
double time_to(const SlidingStone& stone, const IceFactors& ice, double down_ice_m) {
  double before = 0.0, after = rest_of(stone, ice).after_s;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (before + after);
    (slide(stone, ice, middle).stone.y_m - stone.y_m < down_ice_m ? before : after) = middle;
  }
  return after;
}

// Published hog-to-hog times of shots on fast ice, and what FCV1 makes of them.
struct Shot {
  const char* name;
  double speed_mps;
  double hog_to_hog_s;
  double tolerance_s;
};

class PublishedShots : public testing::TestWithParam<Shot> {};

TEST_P(PublishedShots, TakeThePublishedTimeFromHogToHog) {
  const Shot& shot = GetParam();
  EXPECT_NEAR(time_to(thrown(shot.speed_mps, 1.5), {}, hog_to_hog_m), shot.hog_to_hog_s, shot.tolerance_s);
}

INSTANTIATE_TEST_SUITE_P(FromDrawToPeel, PublishedShots,
                         testing::Values(Shot{"tee_draw", 2.09, 13.8, 0.15}, Shot{"back_line", 2.14, 13.2, 0.15},
                                         Shot{"control", 2.32, 11.5, 0.2}, Shot{"normal_hit", 2.54, 10.0, 0.2},
                                         Shot{"firm", 2.76, 9.0, 0.2}, Shot{"peel", 3.30, 7.2, 0.2}),
                         [](const auto& shot) { return std::string(shot.param.name); });

TEST(StoneMotion, ATeeDrawEndsAtTheTeeInThePublishedTimeAndCurl) {
  const SlidingStone stone = thrown(2.09, 1.57);
  const Rest rest = rest_of(stone, {});
  EXPECT_NEAR(rest.y_m, far_tee_m, 0.5);
  EXPECT_GT(rest.after_s, 23.0);
  EXPECT_LT(rest.after_s, 26.0);
  EXPECT_LT(rest.x_m, -0.8) << "counter-clockwise curls left";
  EXPECT_GT(rest.x_m, -1.5);
  const double six_before = time_to(stone, {}, rest.y_m - near_hog_m - 6.0);
  const double late_share = (rest.x_m - slide(stone, {}, six_before).stone.x_m) / rest.x_m;
  EXPECT_GT(late_share, 0.38);
  EXPECT_LT(late_share, 0.52);
}

TEST(StoneMotion, TheDrawIsAsSensitiveAsPublished) {
  const Rest rest = rest_of(thrown(2.09, 1.57), {});
  EXPECT_NEAR(rest.by_start(1, 3) * 0.01, 0.295, 0.02) << "metres for a centimetre a second";
  EXPECT_NEAR(-rest.by_start(1, 4) * 0.01, 0.28, 0.02) << "metres for a hundredth of friction";
  EXPECT_NEAR(std::abs(rest.by_start(0, 5)) * 0.1, 0.15, 0.05) << "metres for a tenth of curl";
}

TEST(StoneMotion, TheFrictionCoefficientIsAStonesOnIce) {
  for (const double speed : {0.3, 0.5, 1.0, 2.0, 2.3}) {
    const double coefficient = deceleration_mps2(speed, {}) / 9.80665;
    EXPECT_GT(coefficient, 0.006) << speed;
    EXPECT_LT(coefficient, 0.016) << speed;
  }
}

struct Ice {
  const char* name;
  SlidingStone stone;
  IceFactors ice;
};

const Ice sheets[] = {
    {"the_model_itself", {0.0, 9.0, 0.02, 2.2, 1.6}, {}},
    {"keen_and_straight", {0.1, 9.0, -0.05, 2.1, -1.2}, {0.85, 0.6, 0.0}},
    {"slow_and_swingy", {-0.2, 9.2, 0.08, 2.5, 1.0}, {1.2, 1.1, 0.0}},
    {"runs_to_one_side", {0.0, 9.0, 0.0, 2.2, -1.6}, {1.0, 0.9, 5e-4}},
    {"spin_dies_on_the_way", {0.0, 9.0, 0.03, 2.2, 0.6}, {1.0, 1.0, -3e-4, 2.0}},
    {"does_not_spin", {0.0, 9.0, 0.03, 2.2, 0.0}, {1.0, 1.0, 2e-4}},
    {"peel", {0.3, 9.0, -0.1, 3.4, -2.0}, {0.95, 0.8, 1e-4}},
    {"crawls", {0.3, 39.0, 0.05, -0.1, -1.0}, {1.1, 0.8, 1e-4}},
};

class OnManySheets : public testing::TestWithParam<Ice> {};

// The simulated rink has its own implementation of the same publication, a plain sum of small steps.
TEST_P(OnManySheets, AgreesWithTheSimulatedRink) {
  const auto& [name, stone, ice] = GetParam();
  hw::sim::StoneScenario scenario;
  scenario.friction_scale = ice.friction_scale;
  scenario.curl_gain = ice.curl_gain;
  scenario.lateral_acceleration_mps2 = ice.lateral_mps2;
  scenario.spin_decay_scale = ice.spin_decay_scale;
  hw::sim::StoneTruth truth;
  truth.x_m = stone.x_m, truth.y_m = stone.y_m, truth.vx_mps = stone.vx_mps, truth.vy_mps = stone.vy_mps;
  truth.spin_radps = stone.spin_radps;
  const double step_s = 2e-4;
  for (int i = 0; i < 250000 && (truth.vx_mps != 0.0 || truth.vy_mps != 0.0); ++i) {
    hw::sim::slide(truth, scenario, step_s);
    if (i == 25000) {
      const Slid mine = slide(stone, ice, step_s * (i + 1));
      EXPECT_NEAR(mine.stone.x_m, truth.x_m, 1e-3);
      EXPECT_NEAR(mine.stone.y_m, truth.y_m, 1e-3);
      EXPECT_NEAR(mine.stone.spin_radps, truth.spin_radps, 1e-3);
    }
  }
  const Rest rest = rest_of(stone, ice);
  EXPECT_NEAR(rest.x_m, truth.x_m, 3e-3);
  EXPECT_NEAR(rest.y_m, truth.y_m, 3e-3);
}

TEST_P(OnManySheets, TwoStretchesAreOne) {
  const auto& [name, stone, ice] = GetParam();
  const double tolerance = ice.spin_decay_scale == 2.0 ? 5e-4 : 1e-4;  // the moment the spin dies falls into a step
  for (const double share : {0.1, 0.5, 0.9, 0.999}) {
    const double whole_s = 0.98 * rest_of(stone, ice).after_s;
    const SlidingStone there = slide(slide(stone, ice, share * whole_s).stone, ice, (1.0 - share) * whole_s).stone;
    const SlidingStone at_once = slide(stone, ice, whole_s).stone;
    EXPECT_NEAR(there.x_m, at_once.x_m, tolerance) << share;
    EXPECT_NEAR(there.y_m, at_once.y_m, tolerance) << share;
    EXPECT_NEAR(there.vy_mps, at_once.vy_mps, tolerance) << share;
  }
}

TEST_P(OnManySheets, GoesBackTheWayItCame) {
  const auto& [name, stone, ice] = GetParam();
  const double whole_s = 0.8 * rest_of(stone, ice).after_s;
  const SlidingStone there = slide(stone, ice, whole_s).stone;
  if (there.spin_radps == 0.0 && stone.spin_radps != 0.0) return;  // a dead spin tells nothing of what it was
  const SlidingStone back = slide(there, ice, -whole_s).stone;
  EXPECT_NEAR(back.x_m, stone.x_m, 1e-3);
  EXPECT_NEAR(back.y_m, stone.y_m, 1e-3);
  EXPECT_NEAR(back.vy_mps, stone.vy_mps, 1e-3);
}

TEST_P(OnManySheets, DerivativesAreDifferences) {
  const auto& [name, stone, ice] = GetParam();
  if (ice.spin_decay_scale == 2.0) return;  // the moment the spin dies is not followed
  const double whole_s = rest_of(stone, ice).after_s;
  for (const double after_s : {0.3 * whole_s, 0.9 * whole_s, 0.998 * whole_s, 1.1 * whole_s}) {
    const Slid slid = slide(stone, ice, after_s);
    for (int column = 0; column < 7; ++column) {
      const double h = column < 4 ? 1e-4 : column == 6 ? 1e-5 : 1e-4;
      const auto shifted = [&](double by) {
        SlidingStone s = stone;
        IceFactors f = ice;
        double* const what[] = {&s.x_m, &s.y_m, &s.vx_mps, &s.vy_mps, &f.friction_scale, &f.curl_gain, &f.lateral_mps2};
        *what[column] += by;
        const SlidingStone to = slide(s, f, after_s).stone;
        return Eigen::Vector4d(to.x_m, to.y_m, to.vx_mps, to.vy_mps);
      };
      const Eigen::Vector4d difference = (shifted(h) - shifted(-h)) / (2.0 * h);
      const double size = 0.01 * (1.0 + difference.norm());
      EXPECT_LT((difference - slid.by_start.col(column)).norm(), size) << "column " << column << " after " << after_s;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sheets, OnManySheets, testing::ValuesIn(sheets),
                         [](const auto& sheet) { return std::string(sheet.param.name); });

RC_GTEST_PROP(StoneMotionProperty, OnlyTheLateralAccelerationKnowsADirection, ()) {
  const double turn = 1e-3 * *rc::gen::inRange(-3141, 3142);
  const double speed = 1e-3 * *rc::gen::inRange(50, 3500);
  const double spin = 1e-3 * *rc::gen::inRange(-2000, 2001);
  const double after_s = 1e-2 * *rc::gen::inRange(0, 3000);
  const SlidingStone straight = slide({0.0, 0.0, 0.0, speed, spin}, {}, after_s).stone;
  const double c = std::cos(turn), s = std::sin(turn);
  const SlidingStone turned = slide({0.0, 0.0, -s * speed, c * speed, spin}, {}, after_s).stone;
  RC_ASSERT(std::abs(turned.x_m - (c * straight.x_m - s * straight.y_m)) < 1e-6);
  RC_ASSERT(std::abs(turned.y_m - (s * straight.x_m + c * straight.y_m)) < 1e-6);
}

RC_GTEST_PROP(StoneMotionProperty, TheOtherSpinIsTheMirrorImage, ()) {
  const double speed = 1e-3 * *rc::gen::inRange(50, 3500);
  const double spin = 1e-3 * *rc::gen::inRange(0, 2001);
  const double lateral = 1e-6 * *rc::gen::inRange(-500, 501);
  const Rest left = rest_of({0.0, 0.0, 0.03, speed, spin}, {1.0, 1.0, lateral});
  const Rest right = rest_of({0.0, 0.0, -0.03, speed, -spin}, {1.0, 1.0, -lateral});
  RC_ASSERT(std::abs(left.x_m + right.x_m) < 1e-9);
  RC_ASSERT(std::abs(left.y_m - right.y_m) < 1e-9);
}

TEST(StoneMotion, AStoneAtRestStays) {
  const SlidingStone stone{0.4, 1.0, 0.0, 0.0, 0.0};
  for (const double dt_s : {-3.0, 0.0, 5.0}) {
    const Slid slid = slide(stone, {1.0, 1.0, 5e-4}, dt_s);
    EXPECT_EQ(slid.stone.x_m, 0.4);
    EXPECT_EQ(slid.stone.y_m, 1.0);
    EXPECT_TRUE(slid.at_rest);
  }
}

}  // namespace
}  // namespace hogline::servo::test
