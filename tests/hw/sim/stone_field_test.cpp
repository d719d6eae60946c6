// Laws of stones that meet: momentum, energy, who is taken off, the same seed the same bytes.
#include "hw/sim/stone_field.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>

#include "hw/sim/stone_motion.hpp"
#include "tests/hw/sim/reference_scenario.hpp"

namespace hogline::hw::sim {
namespace {

using namespace std::chrono_literals;

constexpr Stamp start{1s};
constexpr double width_m = 4.75;

StoneScenario ice() {
  StoneScenario scenario = exact_scenario().stone;
  scenario.restitution = 0.88;
  scenario.stone_friction = 0.1;
  return scenario;
}

FieldStone stone(double x_m, double y_m, double vx_mps = 0.0, double vy_mps = 0.0, double spin_radps = 0.0) {
  return {.motion = {.x_m = x_m, .y_m = y_m, .vx_mps = vx_mps, .vy_mps = vy_mps, .spin_radps = spin_radps}};
}

double energy(const StoneField& field) {
  const double inertia = 0.5 * field.ice().radius_m * field.ice().radius_m;  // per mass
  double sum = 0.0;
  for (const FieldStone& s : field.stones()) {
    const StoneTruth& m = s.motion;
    sum += 0.5 * (m.vx_mps * m.vx_mps + m.vy_mps * m.vy_mps + inertia * m.spin_radps * m.spin_radps);
  }
  return sum;
}

/// A stone that runs at one of a few that lie about.
StoneField random_field(const std::vector<FieldStone>& standing, double aside_m, double speed_mps, double spin_radps) {
  std::vector<FieldStone> stones = standing;
  stones.push_back(stone(aside_m, 3.0, 0.0, -speed_mps, spin_radps));
  return {ice(), width_m, stones, 7, start};
}

double number(int low_mm, int high_mm) { return *rc::gen::inRange(low_mm, high_mm) * 1e-3; }

RC_GTEST_PROP(StoneField, two_stones_that_meet_keep_their_momentum, ()) {
  StoneTruth a{.vx_mps = number(-3000, 3000), .vy_mps = number(-3000, 3000), .spin_radps = number(-6000, 6000)};
  const double angle = number(0, 6283);
  StoneTruth b{.x_m = 0.2899 * std::cos(angle), .y_m = 0.2899 * std::sin(angle), .vx_mps = number(-1000, 1000)};
  const StoneTruth before_a = a, before_b = b;
  collide(a, b, ice());
  RC_ASSERT(std::abs(a.vx_mps + b.vx_mps - before_a.vx_mps - before_b.vx_mps) < 1e-12);
  RC_ASSERT(std::abs(a.vy_mps + b.vy_mps - before_a.vy_mps - before_b.vy_mps) < 1e-12);
}

RC_GTEST_PROP(StoneField, the_energy_never_grows, ()) {
  StoneField field = random_field({stone(0.0, 1.0), stone(0.1, 0.5), stone(-0.3, 0.6)}, number(-300, 300),
                                  number(300, 3500), number(-3000, 3000));
  double last = energy(field);
  while (!field.at_rest()) {
    field.step(field.now() + 20ms);
    RC_ASSERT(energy(field) <= last + 1e-12);
    last = energy(field);
  }
}

RC_GTEST_PROP(StoneField, no_stone_rests_in_another, ()) {
  StoneField field =
      random_field({stone(0.0, 1.0), stone(0.15, 0.7), stone(-0.15, 0.7)}, number(-200, 200), number(300, 3500), 1.5);
  while (!field.at_rest()) field.step(field.now() + 20ms);
  const auto& stones = field.stones();
  for (std::size_t i = 0; i < stones.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (stones[i].taken_off || stones[k].taken_off) continue;
      const double dx = stones[i].motion.x_m - stones[k].motion.x_m, dy = stones[i].motion.y_m - stones[k].motion.y_m;
      RC_ASSERT(std::hypot(dx, dy) > 0.28);
    }
  }
}

TEST(StoneField, a_full_hit_hands_on_what_restitution_says) {
  StoneField field({ice()}, width_m, {stone(0.0, 0.0), stone(0.0, 0.5, 0.0, -2.0)}, 1, start);
  while (field.contacts().empty()) field.step(field.now() + 1ms);
  const StoneContact hit = field.contacts().front();
  EXPECT_EQ(hit.striker, 1);
  EXPECT_EQ(hit.struck, 0);
  EXPECT_NEAR(hit.struck_mps, 0.94 * 2.0, 0.02) << "(1 + 0.88) / 2 of the speed, less what 21 cm of ice took";
}

TEST(StoneField, a_stone_that_is_out_is_caught_and_no_longer_in_the_way) {
  StoneField through({ice()}, width_m, {stone(0.0, 0.0, 0.0, -2.0)}, 1, start);
  while (!through.at_rest()) through.step(through.now() + 10ms);
  EXPECT_TRUE(through.stones()[0].taken_off);
  StoneField beside({ice()}, width_m, {stone(1.0, 3.0, 1.5, -0.5)}, 1, start);
  while (!beside.at_rest()) beside.step(beside.now() + 10ms);
  EXPECT_TRUE(beside.stones()[0].taken_off);
}

TEST(StoneField, the_same_seed_gives_the_same_bytes) {
  const auto played = [](std::uint64_t seed) {
    StoneScenario scenario = ice();
    scenario.throw_friction_sigma = 0.01;
    StoneField field(scenario, width_m, {stone(0.05, 1.0), stone(0.1, 4.0, 0.0, -1.6, 1.5)}, seed, start);
    while (!field.at_rest()) field.step(field.now() + 7ms);
    return field.stones();
  };
  const auto a = played(3), b = played(3), c = played(4);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::memcmp(&a[i].motion, &b[i].motion, sizeof a[i].motion), 0);
    EXPECT_NE(std::memcmp(&a[i].motion, &c[i].motion, sizeof a[i].motion), 0);
  }
}

}  // namespace
}  // namespace hogline::hw::sim
