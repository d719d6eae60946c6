// A camera's counter becomes numbers that only grow.
#include "hw/aravis/frame_numbers.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace hogline::hw {
namespace {

// GigE Vision 1.x: 1 .. 65535 and again from 1.
std::uint64_t narrow(std::uint64_t count) { return (count - 1) % 65535 + 1; }

TEST(FrameNumbers, follow_a_narrow_counter_around) {
  FrameNumbers numbers;
  for (std::uint64_t count = 65400; count < 65535 * 3; ++count) {
    const auto step = numbers.next(narrow(count));
    ASSERT_FALSE(step.backward) << count;
    ASSERT_EQ(step.lost, 0U) << count;
  }
}

TEST(FrameNumbers, count_what_is_lost_across_the_wrap) {
  rc::check("lost frames", [] {
    const auto first = *rc::gen::inRange<std::uint64_t>(1, 65536);
    const auto lost = *rc::gen::inRange<std::uint64_t>(0, 30000);
    FrameNumbers numbers;
    const auto a = numbers.next(narrow(first));
    const auto b = numbers.next(narrow(first + 1 + lost));
    RC_ASSERT(b.lost == lost);
    RC_ASSERT(b.number == a.number + lost + 1);
    RC_ASSERT(!b.backward);
  });
}

TEST(FrameNumbers, a_wide_counter_does_not_wrap_at_16_bits) {
  FrameNumbers numbers;
  numbers.next(65534);
  EXPECT_FALSE(numbers.next(65535).backward);
  EXPECT_FALSE(numbers.next(65536).backward);
  EXPECT_EQ(numbers.next(65540).lost, 3U);
  EXPECT_TRUE(numbers.next(1).backward);
}

TEST(FrameNumbers, a_counter_that_goes_back_or_stands_still_is_told_and_numbers_still_grow) {
  FrameNumbers numbers;
  const auto a = numbers.next(500);
  const auto b = numbers.next(500);
  const auto c = numbers.next(20);
  EXPECT_TRUE(b.backward);
  EXPECT_TRUE(c.backward);
  EXPECT_GT(b.number, a.number);
  EXPECT_GT(c.number, b.number);
}

TEST(FrameNumbers, a_new_start_may_begin_anywhere) {
  FrameNumbers numbers;
  const auto a = numbers.next(500);
  numbers.restart();
  const auto b = numbers.next(1);
  EXPECT_FALSE(b.backward);
  EXPECT_EQ(b.number, a.number + 1);
}

}  // namespace
}  // namespace hogline::hw
