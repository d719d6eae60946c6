#include "src/live/order_words.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hogline {
namespace {

TEST(OrderWords, AreThreeNumbersWithinTheirLimits) {
  const auto shot = read_order("order 2.1 0.5 -1.5");
  ASSERT_TRUE(shot);
  EXPECT_DOUBLE_EQ(shot->speed_mps, 2.1);
  EXPECT_DOUBLE_EQ(shot->heading_rad, 0.5 * std::numbers::pi / 180.0);
  EXPECT_EQ(shot->curl, servo::Curl::clockwise);
  EXPECT_DOUBLE_EQ(shot->spin_radps, 1.5);
  EXPECT_TRUE(read_order("  order\t0.5 -8 6 "));
}

struct Case {
  const char* what;
  const char* line;
};

class NoOrder : public testing::TestWithParam<Case> {};

TEST_P(NoOrder, is_refused) { EXPECT_FALSE(read_order(GetParam().line)) << GetParam().what; }

INSTANTIATE_TEST_SUITE_P(
    Table, NoOrder,
    testing::Values(Case{"another verb", "orderly 2.1 0 1.5"}, Case{"no number", "order"},
                    Case{"two numbers", "order 2.1 0"}, Case{"more than three", "order 2.1 0 1.5 1"},
                    Case{"a word behind them", "order 2.1 0 1.5 junk"}, Case{"a unit", "order 2.1m/s 0 1.5"},
                    Case{"too slow", "order 0.4 0 1.5"}, Case{"too fast", "order 20 0 1.5"},
                    Case{"backwards", "order -2.1 0 1.5"}, Case{"beside the sheet", "order 2.1 9 1.5"},
                    Case{"spins too fast", "order 2.1 0 -6.5"}, Case{"not a number", "order nan 0 1.5"},
                    Case{"not finite", "order 2.1 inf 1.5"}, Case{"a comma", "order 2,1 0 1.5"}));

}  // namespace
}  // namespace hogline
