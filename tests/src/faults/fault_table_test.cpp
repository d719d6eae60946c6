// Every row of the fault table, in a whole simulated throw: found in time, stopped, stone kept, nothing moves on
// recovery, logged with the device's name; or survived within tolerance where that is the design.
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <set>
#include <sstream>

#include "src/faults/fault_page.hpp"

namespace hogline::faults {

void PrintTo(const Case& fault, std::ostream* out) { *out << fault.name << ": " << fault.injected; }

namespace {

class FaultTable : public testing::TestWithParam<Case> {};

TEST_P(FaultTable, ends_as_it_should) {
  const Case& fault = GetParam();
  const Finding finding = try_fault(fault);
  RecordProperty("detected_after_ms", std::to_string(1e3 * finding.detected_after_s.value_or(-1.0)));
  RecordProperty("log", finding.log);
  // What holds in every row, also where the stop is not as it should be.
  EXPECT_FALSE(finding.moved_on_recovery);
  EXPECT_FALSE(finding.moved_on_rearming);
  EXPECT_TRUE(finding.held || finding.result.ok || fault.expect == Expect::brakes_after ||
              fault.expect == Expect::stops_without_stone)
      << "let go outside its window";
  if (!fault.shortcoming.empty()) {
    EXPECT_TRUE(!finding.failures.empty() || finding.over_the_line)
        << "ends as it should, and the page says that it does not";
    return;
  }
  for (const std::string& failure : finding.failures) ADD_FAILURE() << failure << "; log: " << finding.log;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name = std::string(to_string(info.param.group)) + "_" + info.param.name + "_" +
                     to_string(info.param.strike) + "_" + std::to_string(info.index);
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(all, FaultTable, testing::ValuesIn(fault_table()), name_of);

TEST(FaultTrial, the_same_fault_ends_the_same_way) {
  for (const Case& fault : fault_table()) {
    if (fault.name != "one frame in a hundred lost" && fault.name != "server dies") continue;
    if (fault.strike != Strike::full_speed) continue;
    EXPECT_EQ(fault_page({{fault, try_fault(fault)}}), fault_page({{fault, try_fault(fault)}}));
  }
}

TEST(FaultsPage, lists_every_row_of_the_table_and_no_other) {
  std::ifstream stream(FAULTS_PAGE);
  std::stringstream page;
  page << stream.rdbuf();
  const std::string text = page.str();
  ASSERT_FALSE(text.empty()) << FAULTS_PAGE;
  std::set<std::string> rows;
  for (const Case& fault : fault_table()) {
    const std::string row = "\n| " + fault.name + " | " + fault.injected + " | ";
    EXPECT_NE(text.find(row), std::string::npos) << row << "\nrun ./dev doc";
    rows.insert(row);
  }
  std::size_t lines = 0;
  const std::string measured = text.substr(0, text.find("## Tested on the real interface"));
  for (std::size_t at = 0; (at = measured.find("\n| ", at)) != std::string::npos; ++at) ++lines;
  EXPECT_EQ(lines, fault_table().size() + 5) << "one head a group; run ./dev doc";
}

TEST(FaultTable, rows_can_be_told_apart) {
  std::set<std::string> seen;
  for (const Case& fault : fault_table()) {
    EXPECT_TRUE(seen.insert(fault.name + fault.injected + to_string(fault.strike)).second) << fault.name;
    const bool has_deadline = fault.deadline > Duration{};
    EXPECT_EQ(has_deadline, fault.expect != Expect::goes_on) << fault.name;
    EXPECT_EQ(fault.says.empty(), fault.expect == Expect::goes_on) << fault.name;
  }
}

}  // namespace
}  // namespace hogline::faults
