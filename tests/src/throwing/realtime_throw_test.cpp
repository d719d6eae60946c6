// Against the wall clock, of a machine that others may keep busy: what must hold however that goes.
#include "src/throwing/realtime_throw.hpp"

#include <gtest/gtest.h>

#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/throwing/vision_thread.hpp"

namespace hogline {
namespace {

TEST(RealtimeThrow, ends_with_a_good_throw_or_a_reason_and_never_beyond_the_rules) {
  const ThrowRequest request{
      .rig = config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig"),
      .scenario = config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice", 3),
      .order = {.speed_mps = 2.3, .heading_rad = 0.0, .curl = servo::Curl::clockwise, .spin_radps = 1.5},
      .fault = std::nullopt,
      .eyes = Eyes::oracle,
      .follow_stone = false};
  const ThrowResult r = throw_in_real_time(request, {}).result;
  EXPECT_TRUE(r.ok || r.abort) << result_line(r);
  EXPECT_EQ(r.states.back().name, "stopped");
  if (r.release) {
    EXPECT_NEAR(r.release->hog_distance_m, 0.5, request.rig.thrower.release.tolerance_m);
  }
  ASSERT_TRUE(r.realtime);
  EXPECT_GT(r.realtime->periods, 100U);
  EXPECT_LE(r.realtime->frame_to_command_p50_ms, r.realtime->frame_to_command_p99_ms);
  std::printf("%s\n", result_line(r).c_str());
}

TEST(LatencyRecord, gives_nearest_ranks) {
  LatencyRecord record;
  EXPECT_EQ(record.quantile_ms(0.5), 0.0);
  for (int i = 100; i > 0; --i) record.add(std::chrono::milliseconds(i));
  EXPECT_DOUBLE_EQ(record.quantile_ms(0.5), 50.0);
  EXPECT_DOUBLE_EQ(record.quantile_ms(0.99), 99.0);
  EXPECT_DOUBLE_EQ(record.quantile_ms(1.0), 100.0);
  EXPECT_DOUBLE_EQ(record.quantile_ms(0.0), 1.0);
}

}  // namespace
}  // namespace hogline
