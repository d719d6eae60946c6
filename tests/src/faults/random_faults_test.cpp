// Faults at random moments: the same seed gives the same strikes, whoever throws them, and endings are told apart.
#include "src/faults/random_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "src/config/config_error.hpp"
#include "src/faults/strike_journal.hpp"

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
  const auto together = strike_at_random(chosen, 3, 7, 2, [&](const auto&, const auto&) { ++ticks; });
  EXPECT_EQ(ticks, 3);
  EXPECT_EQ(strikes_csv(alone), strikes_csv(together));
  EXPECT_EQ(strikes_page(alone), strikes_page(together));
  EXPECT_NE(alone[0].moment.seed, alone[1].moment.seed);
  EXPECT_TRUE(safe(alone));
}

TEST(RandomFaults, a_campaign_that_was_stopped_goes_on_where_it_was) {
  const auto all = faults_of_any_moment();
  const std::vector<const Case*> chosen{all[0], all[1]};
  const std::string path = testing::TempDir() + "strikes.jsonl";
  std::filesystem::remove(path);
  std::string whole;
  {
    StrikeJournal journal(path, chosen, 7, "a");
    const auto strikes = strike_at_random(
        chosen, 2, 7, 1, [&](const auto& place, const auto& strike) { journal.append(place, strike); });
    whole = strikes_page(strikes);
  }
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 5);  // killed while it wrote
  StrikeJournal journal(path, chosen, 7, "a");
  EXPECT_EQ(journal.known().size(), 3U);
  int struck = 0;
  const auto strikes = strike_at_random(
      chosen, 2, 7, 1, [&](const auto&, const auto&) { ++struck; }, journal.known());
  EXPECT_EQ(struck, 1);
  EXPECT_EQ(strikes_page(strikes), whole);

  EXPECT_THROW(StrikeJournal(path, chosen, 8, "a"), config::ConfigError) << "another seed";
  EXPECT_THROW(StrikeJournal(path, chosen, 7, "b"), config::ConfigError) << "another build";
  std::ofstream(path, std::ios::app) << "rubbish\n";
  EXPECT_THROW(StrikeJournal(path, chosen, 7, "a"), config::ConfigError);
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
