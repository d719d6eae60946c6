// What the skip must do, as a sheet of requirements: whole throws on the simulated rink, seen by the oracle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/skip/skip_figures.hpp"
#include "src/skip/skip_report.hpp"
#include "tests/src/skip/practice.hpp"

namespace hogline::test {
namespace {

using servo::StoneFate;

struct Case {
  const char* name;
  ThrowKind kind;
  std::uint64_t seed;
  bool announced;
  std::size_t least_collisions;
  StoneFate thrown;
};

class Skip : public testing::TestWithParam<Case> {};

TEST_P(Skip, follows_the_throw_to_its_end) {
  const Case& c = GetParam();
  SkipRequest request = practice_throw(c.kind, c.seed);
  request.announced = c.announced;
  request.scenario.skip->passers = {{9.0, 2.0}};
  const SkipOutcome outcome = follow_throw(request);
  ASSERT_TRUE(outcome.report.ok) << outcome.report.reason;
  const SkipFigures f = figures_of(outcome);
  // Aiming.
  EXPECT_LT(f.aim_deg.value(), 0.25) << "the stone in the middle of the far view";
  EXPECT_GT(f.room_deg, 0.0) << "no joint at its limit";
  ASSERT_EQ(f.settle_s.size(), 1U);
  EXPECT_LE(f.settle_s[0], 1.0) << "after somebody stood in the way for two seconds";
  // Tracking.
  EXPECT_EQ(f.swaps, 0);
  EXPECT_LT(f.trajectory.house_m.value(), 0.015);
  EXPECT_LT(f.trajectory.near_hog_m.value(), 0.060);
  EXPECT_LT(f.trajectory.far_hog_m.value(), 0.150);
  EXPECT_LT(std::abs(f.hog_to_hog_error_s.value_or(0.0)), 0.05);
  for (const double e : f.rest_errors_m) EXPECT_LT(e, 0.015) << "where a stone came to rest";
  // Collisions and the rules.
  EXPECT_EQ(f.missed_collisions, 0);
  EXPECT_EQ(f.invented_collisions, 0);
  EXPECT_EQ(f.wrong_fates, 0);
  EXPECT_GE(outcome.report.result.collisions.size(), c.least_collisions);
  const auto& stones = outcome.report.result.stones;
  const auto thrown = std::find_if(stones.begin(), stones.end(), [](const auto& s) { return s.thrown; });
  ASSERT_NE(thrown, stones.end());
  EXPECT_EQ(thrown->fate, c.thrown);
}

INSTANTIATE_TEST_SUITE_P(Throws, Skip,
                         testing::Values(Case{"draw", ThrowKind::draw, 6, true, 0, StoneFate::at_rest},
                                         Case{"double_unannounced", ThrowKind::double_hit, 2, false, 2,
                                              StoneFate::at_rest},
                                         Case{"through", ThrowKind::through, 3, true, 0, StoneFate::through},
                                         Case{"hogged", ThrowKind::hogged, 4, true, 0, StoneFate::hogged},
                                         Case{"sideline", ThrowKind::sideline, 5, false, 0, StoneFate::sideline}),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(SkipThrow, the_same_seed_gives_the_same_report) {
  const auto told = [] {
    SkipRequest request = practice_throw(ThrowKind::guard, 8);
    set_rates(request.scenario, 10.0, 10.0);
    const SkipOutcome outcome = follow_throw(request);
    const ToldThrow t = told_of(outcome, request);
    return throw_json(t, -1) + trajectory_csv(t);
  };
  EXPECT_EQ(told(), told());
}

TEST(SkipThrow, what_it_learns_of_the_ice_comes_near_the_truth) {
  SkipRequest request = practice_throw(ThrowKind::draw, 21);
  request.scenario.stone.friction_scale = 1.12;
  request.scenario.stone.curl_gain = 0.7;
  for (int i = 0; i < 2; ++i) {
    request.scene = draw_scene(ThrowKind::draw, request.scenario, 30 + static_cast<std::uint64_t>(i));
    request.scene.standing.clear();
    request.ice = follow_throw(request).ice;
  }
  EXPECT_EQ(request.ice.throws, 2);
  EXPECT_NEAR(request.ice.friction_scale, 1.12, 0.0112);
  EXPECT_NEAR(request.ice.curl_gain, 0.7, 0.035);
}

}  // namespace
}  // namespace hogline::test
