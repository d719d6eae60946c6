// Where people are beside the run.
#include "hw/sim/people.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hogline::hw::sim {
namespace {

using namespace std::chrono_literals;

const PeopleScenario busy{.count = 12, .nearest_x_m = 1.6, .walk_mps = 1.5};

TEST(People, keep_off_the_run_and_on_their_part_of_the_sheet) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const Stamp stamp : {Stamp{} + 0s, Stamp{} + 3s, Stamp{} + 70s}) {
      const auto people = people_at(busy, seed, stamp);
      ASSERT_EQ(people.size(), 12U);
      for (const auto& p : people) {
        EXPECT_GE(std::abs(p.x_m), 1.6);
        EXPECT_GE(p.y_m, -2.0);
        EXPECT_LE(p.y_m, 8.0);
      }
    }
  }
}

TEST(People, walk_no_faster_than_the_scenario_says_and_some_stand) {
  const auto now = people_at(busy, 4, Stamp{} + 2s);
  const auto then = people_at(busy, 4, Stamp{} + 2100ms);
  int standing = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(now[i].x_m, then[i].x_m);
    EXPECT_LE(std::abs(then[i].y_m - now[i].y_m), 0.15 + 1e-9);
    standing += now[i].y_m == then[i].y_m ? 1 : 0;
  }
  EXPECT_GT(standing, 1);
  EXPECT_LT(standing, 11);
}

TEST(People, are_others_with_another_seed_and_nobody_where_none_are_wanted) {
  EXPECT_NE(people_at(busy, 1, Stamp{})[0].y_m, people_at(busy, 2, Stamp{})[0].y_m);
  EXPECT_TRUE(people_at({}, 1, Stamp{}).empty());
}

}  // namespace
}  // namespace hogline::hw::sim
