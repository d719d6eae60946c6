// Faults at random moments: the same seed gives the same strikes, whoever throws them, and endings are told apart.
#include "src/faults/random_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace hogline::faults {
namespace {

TEST(RandomFaults, each_fault_that_can_strike_at_any_moment_is_there_once) {
  const auto chosen = faults_of_any_moment();
  EXPECT_GT(chosen.size(), 60U);
  std::set<std::string> names;
  for (const Case* fault : chosen) {
    EXPECT_NE(fault->strike, Strike::power_on) << fault->name;
    EXPECT_FALSE(fault->injected.starts_with("the same")) << fault->name;
    names.insert(std::string(to_string(fault->group)) + fault->name + fault->injected);
  }
  EXPECT_EQ(names.size(), chosen.size());
}

TEST(RandomFaults, the_same_seed_gives_the_same_table_whatever_the_jobs) {
  const auto all = faults_of_any_moment();
  const auto silence = std::ranges::find_if(all, [](const Case* fault) { return fault->name == "silence"; });
  ASSERT_NE(silence, all.end());
  const std::vector<const Case*> chosen{*silence};
  const auto alone = strike_at_random(chosen, 3, 7, 1, {});
  int ticks = 0;
  const auto together = strike_at_random(chosen, 3, 7, 2, [&] { ++ticks; });
  EXPECT_EQ(ticks, 3);
  EXPECT_EQ(strikes_csv(alone), strikes_csv(together));
  EXPECT_EQ(strikes_page(alone), strikes_page(together));
  EXPECT_NE(alone[0].moment.seed, alone[1].moment.seed);
  EXPECT_TRUE(safe(alone));
}

TEST(RandomFaults, one_unsafe_ending_is_unsafe) {
  const Case fault;
  RandomStrike strike;
  strike.fault = &fault;
  for (const Ending ending : {Ending::thrown, Ending::kept, Ending::too_late, Ending::lost}) {
    strike.ending = ending;
    EXPECT_TRUE(safe({strike})) << to_string(ending);
  }
  for (const Ending ending : {Ending::carried_over, Ending::outside_window, Ending::not_stopped}) {
    strike.ending = ending;
    EXPECT_FALSE(safe({strike})) << to_string(ending);
    EXPECT_NE(strikes_page({strike}).find(to_string(ending)), std::string::npos);
  }
}

}  // namespace
}  // namespace hogline::faults
