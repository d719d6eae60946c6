// What is physically possible passes; encoder faults do not.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hw/canopen/feedback_check.hpp"

namespace hogline::hw::test {
namespace {

using namespace std::chrono_literals;

const DrivePlausibility limits{
    .standstill_radps = 0.2, .speed_error_radps = 3.0, .speed_error_time = 100ms, .position_mismatch_rad = 0.3};

/// Feeds `span` of a motion speed(t) seen with this scale on the position; true if it is called impossible.
bool rejects(double position_scale, Duration span, double speed_noise_radps = 0.0) {
  FeedbackCheck check(limits, 30.0);
  std::mt19937_64 random(3);
  double last_position = 0.0;
  for (Duration t{0}; t < span; t += 5ms) {
    const double t_s = seconds(t);
    const double position = position_scale * 10.0 * (t_s - std::sin(t_s));
    const double noise = (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5) * 2.0 * speed_noise_radps;
    check.on_feedback(position - last_position, 10.0 * (1.0 - std::cos(t_s)) + noise, 5ms);
    last_position = position;
    if (check.problem()) return true;
  }
  return false;
}

TEST(FeedbackCheck, AnHonestEncoderPassesForAMinute) { EXPECT_FALSE(rejects(1.0, 60s)); }
TEST(FeedbackCheck, ANoisySpeedPasses) { EXPECT_FALSE(rejects(1.0, 60s, 0.5)); }
TEST(FeedbackCheck, AScaleErrorIsFound) { EXPECT_TRUE(rejects(1.2, 10s)); }
TEST(FeedbackCheck, AReversedEncoderIsFound) { EXPECT_TRUE(rejects(-1.0, 10s)); }
TEST(FeedbackCheck, AFrozenPositionIsFound) { EXPECT_TRUE(rejects(0.0, 10s)); }

TEST(FeedbackCheck, AJumpIsFoundAtOnce) {
  FeedbackCheck check(limits, 30.0);
  check.on_feedback(0.05, 10.0, 5ms);
  EXPECT_FALSE(check.problem());
  check.on_feedback(0.05 + 0.4, 10.0, 5ms);
  EXPECT_TRUE(check.problem());
}

TEST(FeedbackCheck, AnImpossibleSpeedIsFound) {
  FeedbackCheck check(limits, 30.0);
  check.on_feedback(0.0, 61.0, 5ms);
  EXPECT_TRUE(check.problem());
}

TEST(FeedbackCheck, ASpeedThatDoesNotFollowIsFoundAfterItsTimeOnly) {
  FeedbackCheck check(limits, 30.0);
  const Stamp t0{10s};
  for (Duration t{0}; t <= 100ms; t += 5ms) check.on_following(10.0, 6.0, t0 + t);
  EXPECT_FALSE(check.problem());
  check.on_following(10.0, 6.0, t0 + 105ms);
  EXPECT_TRUE(check.problem());
}

TEST(FeedbackCheck, ComingBackInTimeIsForgiven) {
  FeedbackCheck check(limits, 30.0);
  const Stamp t0{10s};
  for (Duration t{0}; t < 10s; t += 5ms) {
    check.on_following(10.0, (t / 5ms) % 20 == 19 ? 9.0 : 6.0, t0 + t);
  }
  EXPECT_FALSE(check.problem());
}

TEST(FeedbackCheck, RestartForgets) {
  FeedbackCheck check(limits, 30.0);
  check.on_feedback(5.0, 0.0, 5ms);
  EXPECT_TRUE(check.problem());
  check.restart();
  check.on_feedback(0.0, 0.0, 5ms);
  EXPECT_FALSE(check.problem());
}

}  // namespace
}  // namespace hogline::hw::test
