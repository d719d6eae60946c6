#include "servo/stone_impact.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace hogline::servo::test {
namespace {

StoneMotion stone_at(double x, double y, double vx, double vy, double sigma) {
  StoneMotion m = standing_stone(Stamp{}, x, y, {sigma * sigma, 0.0, sigma * sigma}, {});
  m.stone.vx_mps = vx, m.stone.vy_mps = vy;
  return m;
}

RC_GTEST_PROP(StoneImpactProperty, KeepsTheMomentumAndNeverGainsEnergy, ()) {
  const double aside = 1e-3 * *rc::gen::inRange(-280, 281);
  const double speed = 1e-3 * *rc::gen::inRange(100, 3000);
  const double sigma = 1e-3 * *rc::gen::inRange(1, 60);
  const StoneMotion striker = stone_at(aside, 0.4, 0.0, -speed, sigma), struck = stone_at(0.0, 0.0, 0.0, 0.0, sigma);
  RC_ASSERT(meeting(striker, struck).has_value());
  double whole = 0.0;
  for (const Impact& impact : impacts(striker, struck, {})) {
    const SlidingStone &a = impact.striker.stone, &b = impact.struck.stone;
    RC_ASSERT(std::abs(a.vx_mps + b.vx_mps) < 1e-9);
    RC_ASSERT(std::abs(a.vy_mps + b.vy_mps + speed) < 1e-9);
    const double energy = a.vx_mps * a.vx_mps + a.vy_mps * a.vy_mps + b.vx_mps * b.vx_mps + b.vy_mps * b.vy_mps;
    RC_ASSERT(energy <= speed * speed + 1e-9);
    RC_ASSERT(impact.probability >= 0.0);
    whole += impact.probability;
  }
  RC_ASSERT(std::abs(whole - 1.0) < 1e-9);
}

TEST(StoneImpact, AHeadOnHitGivesThePublishedShareOfTheSpeed) {
  const auto all =
      impacts(stone_at(0.0, 0.4, 0.0, -2.0, 0.001), stone_at(0.0, 0.0, 0.0, 0.0, 0.001), {.restitution = 0.9});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0].struck.stone.vy_mps, -0.95 * 2.0, 1e-6);
  EXPECT_NEAR(all[0].striker.stone.vy_mps, -0.05 * 2.0, 1e-6);
}

TEST(StoneImpact, ThePlacesGoOnAsIfTheyHadTouched) {
  const StoneMotion striker = stone_at(0.1, 0.5, 0.0, -1.5, 0.001), struck = stone_at(0.0, 0.0, 0.0, 0.0, 0.001);
  const auto m = meeting(striker, struck);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->hit, 1.0, 1e-9);
  const Impact impact = impacts(striker, struck, {}).front();
  const auto gap_after = [&](double t) {
    const SlidingStone &a = impact.striker.stone, &b = impact.struck.stone;
    return std::hypot(b.x_m - a.x_m + t * (b.vx_mps - a.vx_mps), b.y_m - a.y_m + t * (b.vy_mps - a.vy_mps));
  };
  EXPECT_NEAR(gap_after(m->after_s), 2.0 * stone_radius_m, 1e-6);
  EXPECT_GT(gap_after(m->after_s + 0.1), 2.0 * stone_radius_m);
}

struct Passing {
  const char* name;
  double aside_m;
  double sigma_m;
  bool meets;
  double least_hit;
  double greatest_hit;
};

class PassingStones : public testing::TestWithParam<Passing> {};

TEST_P(PassingStones, TouchWithTheProbabilityOfTheirDoubt) {
  const Passing& p = GetParam();
  const auto m = meeting(stone_at(p.aside_m, 0.6, 0.0, -2.0, p.sigma_m), stone_at(0.0, 0.0, 0.0, 0.0, p.sigma_m));
  ASSERT_EQ(m.has_value(), p.meets);
  if (!m) return;
  EXPECT_GE(m->hit, p.least_hit);
  EXPECT_LE(m->hit, p.greatest_hit);
}

INSTANTIATE_TEST_SUITE_P(Each, PassingStones,
                         testing::Values(Passing{"full", 0.0, 0.01, true, 0.999, 1.0},
                                         Passing{"on_the_edge", 0.29, 0.01, true, 0.49, 0.51},
                                         Passing{"just_by", 0.31, 0.01, true, 0.05, 0.12},
                                         Passing{"well_by", 0.40, 0.01, false, 0.0, 0.0},
                                         Passing{"who_knows", 0.40, 0.10, true, 0.15, 0.30}),
                         [](const auto& p) { return std::string(p.param.name); });

TEST(StoneImpact, StonesThatPartDoNotMeet) {
  EXPECT_FALSE(meeting(stone_at(0.0, 0.6, 0.0, 2.0, 0.01), stone_at(0.0, 0.0, 0.0, 0.0, 0.01)));
  EXPECT_FALSE(meeting(stone_at(0.0, 0.6, 0.0, 0.0, 0.01), stone_at(0.0, 0.0, 0.0, 0.0, 0.01)));
}

}  // namespace
}  // namespace hogline::servo::test
