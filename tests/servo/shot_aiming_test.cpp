#include "servo/shot_aiming.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "servo/stone_path.hpp"
#include "tests/servo/ice_session.hpp"

namespace hogline::servo::test {
namespace {

IceModel ice_with(double friction, double curl, double lateral) {
  IceEstimate estimate{friction, curl, lateral, {1e-5, 0, 0, 0, 1e-3, 0, 0, 0, 1e-9}, 2};
  return IceModel({}, estimate);
}

Rest thrown(const ShotAim& aim, const IceModel& ice) {
  const double spin = aim.order.curl == Curl::counter_clockwise ? aim.order.spin_radps : -aim.order.spin_radps;
  const double v = aim.order.speed_mps, h = aim.order.heading_rad;
  return rest_of({robot().release.x_m, robot().release.y_m, -v * std::sin(h), v * std::cos(h), spin},
                 ice.estimate().factors());
}

RC_GTEST_PROP(ShotAimingProperty, TheStoneStopsWhereItWasWanted, ()) {
  const IceModel ice = ice_with(1e-3 * *rc::gen::inRange(850, 1200), 1e-3 * *rc::gen::inRange(600, 1100),
                                1e-6 * *rc::gen::inRange(-500, 500));
  const Place wish{1e-3 * *rc::gen::inRange(-1800, 1800), 1e-3 * *rc::gen::inRange(33000, 40000)};
  const Curl curl = *rc::gen::element(Curl::clockwise, Curl::counter_clockwise);
  const ShotAim aim = aim_shot({wish, curl, {}}, robot(), ice);
  RC_ASSERT(aim.ok);
  RC_ASSERT(aim.order.curl == curl);
  const Rest rest = thrown(aim, ice);
  RC_ASSERT(std::hypot(rest.x_m - wish.x_m, rest.y_m - wish.y_m) < 2e-3);
}

RC_GTEST_PROP(ShotAimingProperty, ALineThroughTheHackLeadsThereToo, ()) {
  const IceModel ice = ice_with(1e-3 * *rc::gen::inRange(850, 1200), 1e-3 * *rc::gen::inRange(600, 1100), 0.0);
  const Place wish{1e-3 * *rc::gen::inRange(-1800, 1800), 1e-3 * *rc::gen::inRange(33000, 40000)};
  ThrowerSkill skill = robot();
  skill.line_through_hack = true;
  const ShotAim aim = aim_shot({wish, *rc::gen::element(Curl::clockwise, Curl::counter_clockwise), {}}, skill, ice);
  RC_ASSERT(aim.ok);
  const Place from = release_place(skill, aim.order.heading_rad);
  RC_ASSERT(std::abs(from.x_m + std::tan(aim.order.heading_rad) * from.y_m) < 1e-12);
  const Rest rest = rest_of(released(aim.order, from), ice.estimate().factors());
  RC_ASSERT(std::hypot(rest.x_m - wish.x_m, rest.y_m - wish.y_m) < 2e-3);
}

TEST(ShotAiming, TheStatedSpreadIsThatOfManyThrows) {
  const IceModel ice = ice_with(1.0, 0.9, 2e-4);
  const ShotAim aim = aim_shot({.rest = {0.0, far_tee_m}}, robot(), ice);
  ASSERT_TRUE(aim.ok);
  // 6 mm/s of speed, 0.32 % of friction and the throws' 0.5 %: 0.18, 0.09 and 0.14 m.
  EXPECT_NEAR(std::sqrt(aim.covariance.yy_m2), 0.25, 0.05);
  EXPECT_LT(std::sqrt(aim.covariance.xx_m2), 0.12);
}

TEST(ShotAiming, GoesAroundAGuard) {
  const IceModel ice = ice_with(1.0, 0.9, 0.0);
  const Place wish{0.0, far_tee_m};
  const ShotAim left = aim_shot({wish, Curl::counter_clockwise, {}}, robot(), ice);
  ASSERT_TRUE(left.ok);
  // A guard on the way of the one turn: the other is chosen, and the one asked for is refused.
  const double v = left.order.speed_mps, h = left.order.heading_rad;
  const SlidingStone start{robot().release.x_m, robot().release.y_m, -v * std::sin(h), v * std::cos(h), 1.57};
  const SlidingStone on_the_way = slide(start, ice.estimate().factors(), 15.0).stone;
  const std::vector<Place> guard{{on_the_way.x_m, on_the_way.y_m}};
  const ShotAim around = aim_shot({wish, std::nullopt, guard}, robot(), ice);
  ASSERT_TRUE(around.ok) << around.reason;
  EXPECT_EQ(around.order.curl, Curl::clockwise);
  EXPECT_GT(around.clearance_m, 0.0);
  const ShotAim blocked = aim_shot({wish, Curl::counter_clockwise, guard}, robot(), ice);
  EXPECT_FALSE(blocked.ok);
  EXPECT_EQ(blocked.reason, "the way is not free");
}

RC_GTEST_PROP(ShotAimingProperty, AHitComesToItsPlaceWithItsSpeed, ()) {
  const IceModel ice = ice_with(1e-3 * *rc::gen::inRange(850, 1200), 1e-3 * *rc::gen::inRange(600, 1100),
                                1e-6 * *rc::gen::inRange(-500, 500));
  const Place contact{1e-3 * *rc::gen::inRange(-1800, 1800), 1e-3 * *rc::gen::inRange(33000, 40000)};
  const double speed = 1e-3 * *rc::gen::inRange(200, 2000);
  const HitAim aim = aim_hit({contact, speed}, robot(), ice);
  RC_PRE(aim.reason != "the thrower is not fast enough");
  RC_ASSERT(aim.ok);
  const double spin = aim.order.curl == Curl::counter_clockwise ? aim.order.spin_radps : -aim.order.spin_radps;
  const double v = aim.order.speed_mps, h = aim.order.heading_rad;
  const StonePath path({robot().release.x_m, robot().release.y_m, -v * std::sin(h), v * std::cos(h), spin},
                       ice.estimate().factors());
  const SlidingStone there = path.at(*path.crossing_s(contact.y_m)).stone;
  RC_ASSERT(std::abs(there.x_m - contact.x_m) < 2e-3);
  RC_ASSERT(std::abs(speed_mps(there) - speed) < 1e-3);
  RC_ASSERT(std::abs(std::atan2(-there.vx_mps, there.vy_mps) - aim.heading_rad) < 1e-3);
}

// The stated doubt of a hit is that of many throws by this thrower on ice of this doubt.
TEST(ShotAiming, AHitsStatedDoubtIsThatOfManyThrows) {
  const IceModel ice = ice_with(1.0, 0.9, 2e-4);
  const HitAim aim = aim_hit({{0.3, far_tee_m}, 1.2}, robot(), ice);
  ASSERT_TRUE(aim.ok) << aim.reason;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const double spin = aim.order.curl == Curl::counter_clockwise ? aim.order.spin_radps : -aim.order.spin_radps;
  const Eigen::Matrix3d c = ice.throw_covariance();
  double aside_square = 0.0, speed_square = 0.0;
  const int throws = 400;
  for (int i = 0; i < throws; ++i) {
    const double v = aim.order.speed_mps + robot().speed_sigma_mps * normal(random);
    const double h = aim.order.heading_rad + robot().heading_sigma_rad * normal(random);
    IceFactors factors = ice.estimate().factors();
    factors.friction_scale += std::sqrt(c(0, 0)) * normal(random);
    factors.curl_gain += std::sqrt(c(1, 1)) * normal(random);
    factors.lateral_mps2 += std::sqrt(c(2, 2)) * normal(random);
    const StonePath path({robot().release.x_m, robot().release.y_m, -v * std::sin(h), v * std::cos(h), spin}, factors);
    const SlidingStone there = path.at(*path.crossing_s(far_tee_m)).stone;
    aside_square += std::pow((there.x_m - 0.3) / aim.aside_sigma_m, 2);
    speed_square += std::pow((speed_mps(there) - 1.2) / aim.speed_sigma_mps, 2);
  }
  EXPECT_NEAR(std::sqrt(aside_square / throws), 1.0, 0.12);
  EXPECT_NEAR(std::sqrt(speed_square / throws), 1.0, 0.12);
}

TEST(ShotAiming, AHitThatCanNotBeIsRefused) {
  const IceModel ice = ice_with(1.0, 0.9, 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(aim_hit({{0.0, 5.0}, 1.0}, robot(), ice).reason, "the wanted place is not down-ice of the release");
  EXPECT_EQ(aim_hit({{0.0, 38.0}, 0.0}, robot(), ice).reason, "the wanted speed is none of a hit");
  EXPECT_EQ(aim_hit({{0.0, 38.0}, nan}, robot(), ice).reason, "the wanted speed is none of a hit");
  EXPECT_EQ(aim_hit({{0.0, 38.0}, 3.5}, robot(), ice).reason, "the thrower is not fast enough");
}

struct Impossible {
  const char* name;
  Place rest;
  double max_speed_mps;
  const char* reason;
};

class ImpossibleWishes : public testing::TestWithParam<Impossible> {};

TEST_P(ImpossibleWishes, AreRefusedWithTheReason) {
  ThrowerSkill skill = robot();
  skill.max_speed_mps = GetParam().max_speed_mps;
  const ShotAim aim = aim_shot({.rest = GetParam().rest}, skill, ice_with(1.0, 0.9, 0.0));
  EXPECT_FALSE(aim.ok);
  EXPECT_EQ(aim.reason, GetParam().reason);
}

INSTANTIATE_TEST_SUITE_P(
    Each, ImpossibleWishes,
    testing::Values(Impossible{"behind", {0.0, 5.0}, 3.4, "the wanted place is not down-ice of the release"},
                    Impossible{"too_far", {0.0, 39.0}, 2.0, "the thrower is not fast enough"},
                    Impossible{"aside", {30.0, 20.0}, 3.4, "no release brings a stone there"},
                    Impossible{"nan", {std::numeric_limits<double>::quiet_NaN(), 38.0}, 3.4, "the wish is not finite"}),
    [](const auto& wish) { return std::string(wish.param.name); });

}  // namespace
}  // namespace hogline::servo::test
