// Pictures reach whoever looks at them some time after they were taken: the stone has gone on meanwhile, and the other
// camera's pictures of the same moment may have come long before.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/src/skip/practice.hpp"

namespace hogline::test {
namespace {

SkipRequest with_late_pictures(ThrowKind kind, std::uint64_t seed) {
  SkipRequest request = practice_throw(kind, seed);
  set_rates(request.scenario, 4.0, 4.0);
  request.scenario.skip->far_camera.latency_s = 0.09;
  return request;
}

void expect_followed(const SkipOutcome& outcome, std::size_t least_looks) {
  ASSERT_TRUE(outcome.report.ok) << outcome.report.reason;
  const auto& stones = outcome.report.result.stones;
  const auto thrown = std::find_if(stones.begin(), stones.end(), [](const auto& s) { return s.thrown; });
  ASSERT_NE(thrown, stones.end());
  EXPECT_EQ(thrown->fate, servo::StoneFate::at_rest);
  EXPECT_TRUE(outcome.report.result.hog_to_hog_s);
  EXPECT_GT(outcome.report.result.trajectory.size(), least_looks) << "of about 110 that show it";
}

// The stone is looked for where it was then, not where it is now.
TEST(LatePictures, LoseNoStone) {
  SkipRequest request = with_late_pictures(ThrowKind::draw, 4);
  request.released_after = std::chrono::seconds(8);
  request.eyes = SkipEyes::vision;
  expect_followed(follow_throw(request), 95);
}

// One that nobody tells of is found all the same, also where both cameras expose at once.
TEST(LatePictures, ShowAStoneThatNobodyToldOf) {
  for (const std::uint64_t seed : {1, 2, 4}) {
    SCOPED_TRACE(seed);
    SkipRequest request = with_late_pictures(ThrowKind::draw, seed);
    request.announced = false;
    expect_followed(follow_throw(request), seed == 1 ? 55 : 90);
  }
}

}  // namespace
}  // namespace hogline::test
