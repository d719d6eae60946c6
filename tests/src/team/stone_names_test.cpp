// Which stone is which before and after a throw, as a table of what may have happened.
#include "src/team/stone_names.hpp"

#include <gtest/gtest.h>

namespace hogline {
namespace {

using servo::Board;
using servo::StoneFate;
using servo::StoneOutcome;

constexpr StoneName guard{0, 0}, target{1, 0}, thrown{0, 1};

StoneSighting seen_at(double x_m, double y_m, Team team) {
  StoneSighting s;
  s.x_m = x_m, s.y_m = y_m, s.team = team;
  s.covariance = {1e-5, 0.0, 1e-5};
  return s;
}

// In the skip's e: a guard of the first team at (0.1, 3), a stone of the second at (-0.4, 0.5).
Board two_stones() {
  Board board;
  board.stones[0][0] = on_board(0.1, 3.0, 0.0);
  board.stones[1][0] = on_board(-0.4, 0.5, 0.0);
  return board;
}

StoneOutcome at(int id, double x_m, double y_m, StoneFate fate = StoneFate::at_rest) {
  StoneOutcome outcome;
  outcome.id = id, outcome.fate = fate;
  outcome.x_m = x_m, outcome.y_m = y_m;
  return outcome;
}

/// The target, id 0, is struck; the guard, id 1, stands; the thrown one, id 2.
SeenThrow a_hit(StoneOutcome struck, StoneOutcome thrown_stone) {
  SeenThrow seen{.before = two_stones(), .thrown = thrown, .names = {target, guard}, .followed = {}, .counted = {}};
  servo::ThrowResult result;
  thrown_stone.thrown = true;
  struck.moved = true;
  result.stones = {struck, at(1, 0.1, 3.0), thrown_stone};
  servo::WorldCollision hit;
  hit.striker = 2, hit.struck = 0;
  result.collisions = {hit};
  seen.followed = result;
  return seen;
}

std::optional<servo::Place> place(const StonesAfter& after, const StoneName& name) {
  const auto& stone = after.stones.lying.stones[name.side][name.stone];
  return stone ? std::optional(in_skip_frame(*stone)) : std::nullopt;
}

TEST(StoneNames, ThereAndBackIsTheSamePlace) {
  const servo::Place p = in_skip_frame(on_board(0.7, -1.2, 0.3));
  EXPECT_NEAR(p.x_m, 0.7, 1e-12);
  EXPECT_NEAR(p.y_m, -1.2, 1e-12);
}

TEST(StoneNames, ByPlaceAndTeam) {
  const auto names = names_of({seen_at(-0.41, 0.52, Team::second), seen_at(0.1, 3.02, Team::unknown),
                               seen_at(1.2, 1.0, Team::first), seen_at(0.12, 3.1, Team::second)},
                              two_stones());
  EXPECT_EQ(names[0], target);
  EXPECT_EQ(names[1], guard) << "of an unknown team, where a stone lies";
  EXPECT_FALSE(names[2]) << "no stone lies there";
  EXPECT_FALSE(names[3]) << "no stone of that team lies there";
}

TEST(StonesAfter, CountingSaysWhere) {
  SeenThrow seen = a_hit(at(0, -0.9, -1.0), at(2, -0.3, 0.6));
  seen.counted = {seen_at(-0.92, -1.01, Team::second), seen_at(0.1, 3.0, Team::first),
                  seen_at(-0.31, 0.62, Team::first)};
  const StonesAfter after = stones_after(seen);
  EXPECT_TRUE(after.stones.struck);
  EXPECT_TRUE(after.remarks.empty());
  EXPECT_NEAR(place(after, target)->x_m, -0.92, 1e-9);
  EXPECT_NEAR(place(after, thrown)->y_m, 0.62, 1e-9);
  EXPECT_NEAR(place(after, guard)->y_m, 3.0, 1e-9);
}

TEST(StonesAfter, WhatIsSurelyOutStaysOutEvenIfItLiesThere) {
  SeenThrow seen = a_hit(at(0, -2.0, -0.5, StoneFate::sideline), at(2, -0.3, 0.6));
  seen.counted = {seen_at(-2.0, -0.52, Team::second), seen_at(0.1, 3.0, Team::first), seen_at(-0.3, 0.6, Team::first)};
  EXPECT_FALSE(place(stones_after(seen), target));
}

TEST(StonesAfter, InDoubtTheCountDecides) {
  StoneOutcome through = at(0, -0.9, -1.9, StoneFate::through);
  through.certain = false;
  SeenThrow seen = a_hit(through, at(2, -0.3, 0.6));
  seen.counted = {seen_at(-0.9, -1.88, Team::second), seen_at(0.1, 3.0, Team::first), seen_at(-0.3, 0.6, Team::first)};
  EXPECT_TRUE(place(stones_after(seen), target)) << "it lies there: the rules say whether it may";
  seen.counted->erase(seen.counted->begin());
  EXPECT_FALSE(place(stones_after(seen), target));
}

TEST(StonesAfter, ALostStoneIsFoundByItsTeam) {
  SeenThrow seen = a_hit(at(0, 0.3, 0.0, StoneFate::lost), at(2, -0.3, 0.6));
  seen.counted = {seen_at(1.1, -1.2, Team::second), seen_at(0.1, 3.0, Team::first), seen_at(-0.3, 0.6, Team::first)};
  const StonesAfter after = stones_after(seen);
  EXPECT_NEAR(place(after, target)->x_m, 1.1, 1e-9);
  EXPECT_EQ(after.remarks.size(), 1U) << "and that is said";
}

TEST(StonesAfter, NotSeenInTheCountIsBelievedAndSaid) {
  SeenThrow seen = a_hit(at(0, -0.9, -1.0), at(2, -0.3, 0.6));
  seen.counted = {seen_at(0.1, 3.0, Team::first), seen_at(-0.3, 0.6, Team::first)};
  const StonesAfter after = stones_after(seen);
  EXPECT_NEAR(place(after, target)->y_m, -1.0, 1e-9);
  EXPECT_EQ(after.remarks.size(), 1U);
}

TEST(StonesAfter, WithoutFollowingTheCountAloneCounts) {
  SeenThrow seen{.before = two_stones(), .thrown = thrown, .names = {target, guard}, .followed = {}, .counted = {}};
  seen.counted = {seen_at(-0.4, 0.5, Team::second), seen_at(0.1, 3.0, Team::first), seen_at(0.9, -0.4, Team::first)};
  const StonesAfter after = stones_after(seen);
  EXPECT_FALSE(after.stones.struck);
  EXPECT_NEAR(place(after, thrown)->x_m, 0.9, 1e-9);
}

TEST(StonesAfter, AStoneThatIsCountedElsewhereWasStruckThoughNobodySawIt) {
  SeenThrow seen = a_hit(at(0, -0.4, 0.5), at(2, -0.3, 0.6));
  seen.followed->collisions.clear();
  seen.counted = {seen_at(-0.4, 0.51, Team::second), seen_at(0.11, 3.0, Team::first), seen_at(0.9, -0.4, Team::first)};
  EXPECT_FALSE(stones_after(seen).stones.struck) << "1 cm is what looks differ by";
  seen.counted->front().y_m = 0.55;
  EXPECT_FALSE(stones_after(seen).stones.struck) << "along the sight a whole look may be shifted";
  seen.counted->front() = seen_at(-0.43, 0.51, Team::second);
  EXPECT_TRUE(stones_after(seen).stones.struck);
  seen.counted->front().covariance = {1e-4, 0.0, 1e-4};
  EXPECT_FALSE(stones_after(seen).stones.struck) << "not seen surely enough";
}

TEST(StonesAfter, SomethingThatIsNoStoneOfTheirsChangesNothing) {
  SeenThrow seen = a_hit(at(0, -2.0, -0.5, StoneFate::through), at(2, -0.3, 0.6));
  seen.counted = {seen_at(0.1, 3.0, Team::first), seen_at(-0.3, 0.6, Team::first), seen_at(1.3, 1.9, Team::second)};
  const StonesAfter after = stones_after(seen);
  EXPECT_FALSE(place(after, target));
  EXPECT_EQ(after.remarks.size(), 1U);
}

}  // namespace
}  // namespace hogline
