// The offset of two clocks from the heartbeats' echoes.
#include "hw/link/clock_offset.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace hogline::hw::link {
namespace {

using namespace std::chrono_literals;

TeamTime at(Duration since_1970) { return TeamTime{since_1970}; }

// One exchange: out in `out`, held for `held`, back in `back`; their clock is `ahead` of ours.
void exchange(ClockOffset& clock, Duration begin, Duration out, Duration held, Duration back, Duration ahead) {
  clock.add(at(begin), at(begin + out + ahead), at(begin + out + held + ahead), at(begin + out + held + back));
}

TEST(ClockOffset, says_nothing_before_a_whole_exchange) { EXPECT_FALSE(ClockOffset{}.estimate()); }

TEST(ClockOffset, equal_ways_cancel) {
  ClockOffset clock;
  exchange(clock, 100s, 2ms, 40ms, 2ms, -3s);
  ASSERT_TRUE(clock.estimate());
  EXPECT_EQ(clock.estimate()->offset, Duration{-3s});
  EXPECT_EQ(clock.estimate()->round_trip, Duration{4ms});
}

TEST(ClockOffset, the_shortest_of_the_last_sixteen_counts) {
  ClockOffset clock;
  exchange(clock, 1s, 1ms, 10ms, 1ms, 5ms);
  for (int i = 0; i < 15; ++i) exchange(clock, 2s, 30ms, 10ms, 1ms, 5ms);
  EXPECT_EQ(clock.estimate()->offset, Duration{5ms});
  exchange(clock, 3s, 8ms, 10ms, 2ms, 5ms);  // the sixteenth after it: the first is forgotten
  EXPECT_EQ(clock.estimate()->round_trip, Duration{10ms});
}

TEST(ClockOffset, an_exchange_out_of_order_is_left_out) {
  ClockOffset clock;
  clock.add(at(10s), at(9s), at(8s), at(11s));    // answered before it was heard
  clock.add(at(10s), at(11s), at(15s), at(11s));  // held for longer than the whole took
  clock.add(at(10s), at(10s), at(10s), at(9s));   // came back before it went
  EXPECT_FALSE(clock.estimate());
}

RC_GTEST_PROP(ClockOffset, the_true_offset_lies_within_the_bound, ()) {
  ClockOffset clock;
  const Duration ahead{*rc::gen::inRange<std::int64_t>(-10'000'000'000, 10'000'000'000)};
  const int count = *rc::gen::inRange(1, 40);
  for (int i = 0; i < count; ++i) {
    const auto way = [] { return Duration{*rc::gen::inRange<std::int64_t>(0, 50'000'000)}; };
    exchange(clock, 100s + i * 50ms, way(), way(), way(), ahead);
  }
  const auto estimate = clock.estimate();
  RC_ASSERT(estimate.has_value());
  const Duration wrong = estimate->offset > ahead ? estimate->offset - ahead : ahead - estimate->offset;
  RC_ASSERT(wrong <= estimate->bound + 1ns);
}

}  // namespace
}  // namespace hogline::hw::link
