#include "hw/socketcan/receive_stamp.hpp"

#include <gtest/gtest.h>

using namespace hogline;
using namespace hogline::hw;
using namespace std::chrono_literals;

namespace {

const ClockPair now{1795302065s, Stamp{} + 500s};

TEST(ReceiveStamp, IsAsOldInTheSteadyClockAsInTheWallClock) {
  EXPECT_EQ(to_steady(now.wall - 7ms, now, 2s), now.steady - 7ms);
}

TEST(ReceiveStamp, IsNeverInTheFuture) { EXPECT_EQ(to_steady(now.wall + 500us, now, 2s), now.steady); }

TEST(ReceiveStamp, AWallClockThatWasSetGivesNoStamp) {
  EXPECT_FALSE(to_steady(now.wall - 3600s, now, 2s)) << "set forward by an hour after the frame came";
  EXPECT_FALSE(to_steady(now.wall + 3600s, now, 2s)) << "set back by an hour";
}

TEST(ReceiveStamp, AMissingKernelStampGivesNoStamp) { EXPECT_FALSE(to_steady(Duration::zero(), now, 2s)); }

}  // namespace
