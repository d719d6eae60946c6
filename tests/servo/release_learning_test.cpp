#include "servo/release_learning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

ReleaseKnowledge prior() {
  ReleaseConfig config = thrower_config().release;
  config.gripper_delay_s = 0.075;
  config.gripper_delay_sigma_s = 0.005;
  config.drag_mps = 0.003;
  config.drag_sigma_mps = 0.003;
  return prior_of(config);
}

TEST(ReleaseLearning, FindsDelayAndDragWithinTheSigmasItStates) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  double normalised = 0.0;
  int count = 0;
  for (int session = 0; session < 200; ++session) {
    const double delay = 0.075 + 0.005 * normal(random);
    const double drag = 0.003 + 0.003 * normal(random);
    ReleaseKnowledge k = prior();
    for (int i = 0; i < 20; ++i) {
      k = learn(k, {.delay_s = delay + 0.0025 * normal(random),
                    .delay_sigma_s = 0.0025,
                    .drag_mps = drag + 0.010 * normal(random),
                    .drag_sigma_mps = 0.010})
              .knowledge;
    }
    EXPECT_LT(std::abs(k.delay_s - delay), 0.004);
    normalised += std::pow(k.delay_s - delay, 2) / k.covariance[0] + std::pow(k.drag_mps - drag, 2) / k.covariance[3];
    count += 2;
    EXPECT_LT(std::sqrt(k.covariance[0]), 0.0012);
    EXPECT_LT(std::sqrt(k.covariance[3]), 0.0022);
    EXPECT_EQ(k.throws, 20);
  }
  EXPECT_NEAR(normalised / count, 0.9, 0.25) << "sigmas are neither too small nor too large";
}

TEST(ReleaseLearning, FollowsJawsThatWear) {
  ReleaseKnowledge k = prior();
  double delay = 0.070;
  for (int i = 0; i < 200; ++i, delay += 0.0001) {
    k = learn(k, {.delay_s = delay, .delay_sigma_s = 0.0025, .drag_mps = {}, .drag_sigma_mps = 0.0}).knowledge;
  }
  EXPECT_NEAR(k.delay_s, delay, 0.001);
  EXPECT_NEAR(k.drag_mps, 0.003, 1e-12) << "nothing was said of it";
}

TEST(ReleaseLearning, DoesNotBelieveEverything) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ReleaseKnowledge before = prior();
  for (const ReleaseFeedback& wrong :
       {ReleaseFeedback{.delay_s = 0.5, .delay_sigma_s = 0.0025, .drag_mps = {}, .drag_sigma_mps = 0.0},
        ReleaseFeedback{.delay_s = nan, .delay_sigma_s = 0.0025, .drag_mps = {}, .drag_sigma_mps = 0.0},
        ReleaseFeedback{.delay_s = 0.075, .delay_sigma_s = 0.0, .drag_mps = {}, .drag_sigma_mps = 0.0},
        ReleaseFeedback{.delay_s = {}, .delay_sigma_s = 0.0, .drag_mps = -0.3, .drag_sigma_mps = 0.01}}) {
    const ReleaseLesson lesson = learn(before, wrong);
    EXPECT_FALSE(lesson.refused.empty());
    EXPECT_DOUBLE_EQ(lesson.knowledge.delay_s, before.delay_s);
    EXPECT_DOUBLE_EQ(lesson.knowledge.drag_mps, before.drag_mps);
    EXPECT_EQ(lesson.knowledge.throws, 0);
  }
}

TEST(ReleaseLearning, WhatWasLearntStandsInTheRigsPlace) {
  ReleaseKnowledge k = prior();
  k.delay_s = 0.081;
  k.drag_mps = 0.0042;
  const ReleaseConfig config = with_knowledge(thrower_config().release, k);
  EXPECT_DOUBLE_EQ(config.gripper_delay_s, 0.081);
  EXPECT_DOUBLE_EQ(config.gripper_delay_sigma_s, 0.005);
  EXPECT_DOUBLE_EQ(config.drag_mps, 0.0042);
  EXPECT_DOUBLE_EQ(config.hog_distance_m, thrower_config().release.hog_distance_m);
}

}  // namespace
}  // namespace hogline::servo::test
