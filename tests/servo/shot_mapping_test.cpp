#include "servo/shot_mapping.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "servo/first_contact.hpp"
#include "tests/servo/ice_session.hpp"

namespace hogline::servo::test {
namespace {

constexpr double width_m = 4.75;

IceModel ice_with(double friction, double curl, double lateral) {
  return IceModel({}, IceEstimate{friction, curl, lateral, {1e-5, 0, 0, 0, 1e-3, 0, 0, 0, 1e-9}, 2});
}

/// A stone in millisecond steps up to its first touch, to where it leaves play, or to rest.
IntendedOutcome stepped(SlidingStone start, const IceFactors& ice, const Surroundings& around) {
  const hw::sim::StoneScenario scenario = scenario_of(ice);
  hw::sim::StoneTruth stone{start.x_m, start.y_m, start.vx_mps, start.vy_mps, start.spin_radps, 0.0};
  const auto ended = [&](Intent intent, std::size_t index) {
    return IntendedOutcome{intent,
                           {stone.x_m, stone.y_m},
                           std::hypot(stone.vx_mps, stone.vy_mps),
                           std::atan2(-stone.vx_mps, stone.vy_mps),
                           index};
  };
  while (stone.vx_mps != 0.0 || stone.vy_mps != 0.0) {
    hw::sim::slide(stone, scenario, step_s);
    for (std::size_t i = 0; i < around.stones.size(); ++i) {
      if (std::hypot(stone.x_m - around.stones[i].x_m, stone.y_m - around.stones[i].y_m) <= 0.29)
        return ended(Intent::touch, i);
    }
    const bool aside = around.sheet_width_m && std::abs(stone.x_m) + 0.145 >= 0.5 * *around.sheet_width_m;
    if (aside || stone.y_m - 0.145 >= 40.234) return ended(Intent::leave, 0);
  }
  return ended(Intent::rest, 0);
}

SlidingStone at_the_hack(const HackShot& shot) {
  const double spin = shot.curl == Curl::counter_clockwise ? 1.0 : -1.0;
  return {0.0, 0.0, shot.vx_mps, shot.vy_mps, spin * 0.5 * std::numbers::pi};
}

/// Draws and hits around the house, as strategy programs give them.
HackShot any_shot(std::mt19937_64& random) {
  std::uniform_real_distribution<double> speed(2.25, 3.4), angle(-0.01, 0.09);
  const double v = speed(random), h = angle(random);
  if (random() % 2 == 0) return {v * std::sin(h), v * std::cos(h), Curl::counter_clockwise};
  return {-v * std::sin(h), v * std::cos(h), Curl::clockwise};
}

Surroundings any_stones(std::mt19937_64& random, int count) {
  std::uniform_real_distribution<double> x(-1.5, 1.5), y(34.0, 40.0);
  Surroundings around{{}, width_m};
  while (std::ssize(around.stones) < count) {
    const Place place{x(random), y(random)};
    const bool free = std::ranges::none_of(around.stones, [&](const Place& other) {
      return std::hypot(place.x_m - other.x_m, place.y_m - other.y_m) < 0.3;
    });
    if (free) around.stones.push_back(place);
  }
  return around;
}

// A tenth of a degree at a grazing touch is centimetres: what is compared is whether stones come to the same touch, by
// the margin that millisecond steps leave.
TEST(IntendedOutcome, IsThatOfTheSimulatorsStone) {
  std::mt19937_64 random(7);
  int touches = 0, rests = 0, leaves = 0, other = 0;
  for (int i = 0; i < 300; ++i) {
    const HackShot shot = any_shot(random);
    const Surroundings around = any_stones(random, static_cast<int>(random() % 9));
    const IntendedOutcome by_model = intended_outcome(shot, around);
    const IntendedOutcome by_steps = stepped(at_the_hack(shot), {}, around);
    if (by_model.intent != by_steps.intent || by_model.stone != by_steps.stone) {
      ++other;
      continue;
    }
    touches += by_model.intent == Intent::touch ? 1 : 0;
    rests += by_model.intent == Intent::rest ? 1 : 0;
    leaves += by_model.intent == Intent::leave ? 1 : 0;
    EXPECT_NEAR(by_model.speed_mps, by_steps.speed_mps, 3e-3) << i;
    EXPECT_NEAR(by_model.heading_rad, by_steps.heading_rad, 3e-3) << i;
    // Steps of a millisecond pass a touch by up to 3 mm along the way; a sideline is neared at a few degrees.
    EXPECT_NEAR(by_model.place.x_m, by_steps.place.x_m, 5e-3) << i;
    EXPECT_NEAR(by_model.place.y_m, by_steps.place.y_m, by_model.intent == Intent::touch ? 6e-3 : 0.04) << i;
  }
  EXPECT_GT(touches, 60);
  EXPECT_GT(rests, 20);
  EXPECT_GT(leaves, 60);
  EXPECT_LE(other, 3) << "grazing touches that steps miss or make";
}

struct Tally {
  int ok = 0, touches = 0, same = 0;
  double worst_heading_rad = 0.0;
  std::map<std::string, int> refused;
};

// Thrown by another program's ice: what the order comes to there is what the shot came to by FCV1.
TEST(ShotMapping, ThrownOnOtherIceTheShotComesToTheSame) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> friction(0.85, 1.2), curl(0.6, 1.1), lateral(-3e-4, 3e-4);
  Tally tally;
  const int shots = 400;
  for (int i = 0; i < shots; ++i) {
    const IceModel ice = ice_with(friction(random), curl(random), lateral(random));
    const HackShot shot = any_shot(random);
    const Surroundings around = any_stones(random, static_cast<int>(random() % 7));
    const MappedShot mapped = map_shot(shot, around, robot(), ice);
    if (!mapped.ok) {
      ASSERT_FALSE(mapped.reason.empty());
      ++tally.refused[mapped.reason];
      continue;
    }
    ++tally.ok;
    EXPECT_EQ(mapped.order.curl, shot.curl);
    EXPECT_GT(mapped.sigma_m, 0.0);
    const IntendedOutcome there = stepped(released(mapped.order, robot().release), ice.estimate().factors(), around);
    if (there.intent != mapped.intended.intent || there.stone != mapped.intended.stone) continue;
    ++tally.same;
    tally.touches += there.intent == Intent::touch ? 1 : 0;
    const double off =
        std::hypot(there.place.x_m - mapped.intended.place.x_m, there.place.y_m - mapped.intended.place.y_m);
    EXPECT_LT(off, there.intent == Intent::rest ? 0.02 : there.intent == Intent::touch ? 8e-3 : 0.5) << i;
    EXPECT_NEAR(there.speed_mps, std::max(mapped.intended.speed_mps, there.intent == Intent::rest ? 0.0 : 0.1), 5e-3)
        << i;
    EXPECT_NEAR(there.heading_rad - mapped.intended.heading_rad, mapped.off_heading_rad, 4e-3) << i;
    EXPECT_LT(std::abs(mapped.off_heading_rad), 0.1) << i;
    if (there.intent == Intent::touch)
      tally.worst_heading_rad = std::max(tally.worst_heading_rad, std::abs(mapped.off_heading_rad));
  }
  EXPECT_GE(tally.same, tally.ok - 3);
  EXPECT_GT(tally.ok, shots * 7 / 10);
  EXPECT_GT(tally.touches, shots / 4);
  for (const auto& [reason, count] : tally.refused) std::printf("%4d refused: %s\n", count, reason.c_str());
  std::printf("%d of %d mapped, %d came to the same, %d touches, headings there within %.3f rad\n", tally.ok, shots,
              tally.same, tally.touches, tally.worst_heading_rad);
}

TEST(ShotMapping, OnFcv1sOwnIceTheWayIsTheSameToo) {
  // A release on the shot's own way, where its heading is what it is there.
  const HackShot shot{0.132, 2.3995, Curl::counter_clockwise};
  const StonePath path(at_the_hack(shot), {});
  const SlidingStone let_go = path.at(*path.crossing_s(9.0)).stone;
  ThrowerSkill skill = robot();
  skill.release = {let_go.x_m, 9.0};
  skill.spin_radps = std::abs(let_go.spin_radps);
  const MappedShot mapped = map_shot(shot, {{}, width_m}, skill, ice_with(1.0, 1.0, 0.0));
  ASSERT_TRUE(mapped.ok) << mapped.reason;
  EXPECT_NEAR(mapped.order.speed_mps, speed_mps(let_go), 5e-4);
  EXPECT_NEAR(mapped.order.heading_rad, std::atan2(-let_go.vx_mps, let_go.vy_mps), 1e-4);
}

RC_GTEST_PROP(ShotMappingProperty, AnOutcomeHasAShotThatComesToIt, ()) {
  const bool rest = *rc::gen::arbitrary<bool>();
  const Curl curl = *rc::gen::element(Curl::clockwise, Curl::counter_clockwise);
  IntendedOutcome outcome{rest ? Intent::rest : Intent::touch,
                          {1e-3 * *rc::gen::inRange(-1500, 1500), 1e-3 * *rc::gen::inRange(33000, 40000)}};
  if (!rest) outcome.speed_mps = 1e-3 * *rc::gen::inRange(300, 2000);
  const auto shot = hack_shot_for(outcome, curl);
  RC_ASSERT(shot);
  const StonePath path(at_the_hack(*shot), {});
  const SlidingStone there =
      rest ? path.at(path.rest().after_s).stone : path.at(*path.crossing_s(outcome.place.y_m)).stone;
  RC_ASSERT(std::hypot(there.x_m - outcome.place.x_m, there.y_m - outcome.place.y_m) < 2e-3);
  RC_ASSERT(std::abs(speed_mps(there) - outcome.speed_mps) < 1e-3);
}

struct Impossible {
  const char* name;
  HackShot shot;
  std::vector<Place> stones;
  double max_speed_mps;
  const char* reason;
};

class ImpossibleShots : public testing::TestWithParam<Impossible> {};

TEST_P(ImpossibleShots, AreRefusedWithTheReason) {
  ThrowerSkill skill = robot();
  skill.max_speed_mps = GetParam().max_speed_mps;
  const MappedShot mapped = map_shot(GetParam().shot, {GetParam().stones, width_m}, skill, ice_with(1.1, 0.8, 0.0));
  EXPECT_FALSE(mapped.ok);
  EXPECT_EQ(mapped.reason, GetParam().reason);
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Each, ImpossibleShots,
    testing::Values(
        Impossible{"nan", {nan, 2.4, Curl::clockwise}, {}, 3.4, "the shot's velocity is not finite"},
        Impossible{"backwards", {0.1, -2.4, Curl::clockwise}, {}, 3.4, "the shot does not go down-ice"},
        Impossible{"at_no_speed", {0.0, 0.0, Curl::clockwise}, {}, 3.4, "the shot does not go down-ice"},
        Impossible{"absurd", {0.0, 300.0, Curl::clockwise}, {}, 3.4, "the shot is faster than any stone"},
        Impossible{"too_fast", {0.0, 3.9, Curl::clockwise}, {{0.4, 38.0}}, 3.4, "the thrower is not fast enough"},
        Impossible{
            "too_short", {0.0, 0.9, Curl::clockwise}, {}, 3.4, "the wanted place is not down-ice of the release"}),
    [](const auto& shot) { return std::string(shot.param.name); });

// A stone that runs straight on: the touch is where two discs of 0.145 m meet.
RC_GTEST_PROP(FirstContactProperty, IsWhereTheDiscsMeet, ()) {
  const double aside = 1e-5 * *rc::gen::inRange(-35000, 35000);
  const StonePath path({0.0, 10.0, 0.0, 2.5, 0.0}, {.curl_gain = 0.0});
  const std::vector<Place> standing{{3.0, 20.0}, {aside, 25.0}, {-0.1, 36.0}};
  const auto contact = first_contact(path, standing);
  RC_ASSERT(contact);
  const bool touches = std::abs(aside) < 0.29;
  RC_ASSERT(contact->stone == (touches ? 1u : 2u));
  const double x = touches ? aside : -0.1, y = touches ? 25.0 : 36.0;
  RC_ASSERT(std::abs(contact->striker.y_m - (y - std::sqrt(0.29 * 0.29 - x * x))) < 1e-4);
}

TEST(FirstContact, IsNoneOfAStoneThatStopsBefore) {
  const StonePath path({0.0, 10.0, 0.0, 1.0, 0.0}, {});
  const std::vector<Place> standing{{0.0, path.rest().y_m + 0.3}};
  EXPECT_FALSE(first_contact(path, standing));
  EXPECT_FALSE(first_contact(path, {}));
}

}  // namespace
}  // namespace hogline::servo::test
