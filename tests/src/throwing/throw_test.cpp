// A sheet of requirements for the whole thrower: real controllers, adapters and vision on the simulated rink.
#include <gsl/gsl_errno.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/throwing/simulated_throw.hpp"

namespace hogline {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double hog_line_y_m = 6.401;

struct Shot {
  const char* description;
  std::uint64_t seed;
  double speed_mps;
  double heading_deg;
  servo::Curl curl;
};

void PrintTo(const Shot& shot, std::ostream* out) { *out << shot.description; }

ThrowRequest request_of(const Shot& shot) {
  gsl_set_error_handler_off();
  return {.rig = config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig"),
          .scenario = config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice", shot.seed),
          .order = {.speed_mps = shot.speed_mps,
                    .heading_rad = shot.heading_deg * degree,
                    .curl = shot.curl,
                    .spin_radps = 1.5},
          .fault = std::nullopt,
          .follow_stone = false};
}

const Shot tee_draw{"tee draw", 3, 2.09, 0.0, servo::Curl::counter_clockwise};

class Throws : public testing::TestWithParam<Shot> {};

TEST_P(Throws, are_released_in_their_window) {
  const Shot& shot = GetParam();
  const ThrowResult r = throw_stone(request_of(shot), {}).result;
  ASSERT_TRUE(r.release) << r.abort.value_or("no abort");
  EXPECT_TRUE(r.ok);
  EXPECT_FALSE(r.abort) << *r.abort;
  EXPECT_FALSE(r.hog_line_violation);
  EXPECT_FALSE(r.stone_burned);
  EXPECT_NEAR(r.release->hog_distance_m, r.release->target_hog_distance_m, 0.050);
  EXPECT_NEAR(r.release->speed_error_mps, 0.0, 0.030);
  EXPECT_NEAR(r.release->heading_error_rad, 0.0, 0.15 * degree);
  EXPECT_NEAR(r.release->lateral_error_m, 0.0, 0.030);
  EXPECT_NEAR(r.release->spin_error_radps, 0.0, 0.10);
  ASSERT_TRUE(r.yaw_after_alignment_rad);
  EXPECT_NEAR(*r.yaw_after_alignment_rad, 0.0, 0.10 * degree);
}

INSTANTIATE_TEST_SUITE_P(Table, Throws,
                         testing::Values(Shot{"guard", 1, 1.91, 0.4, servo::Curl::counter_clockwise},
                                         Shot{"tee draw", 2, 2.09, -0.4, servo::Curl::clockwise},
                                         Shot{"normal hit", 9, 2.54, 0.8, servo::Curl::counter_clockwise}));

class Faults : public testing::TestWithParam<const char*> {};

TEST_P(Faults, early_in_the_run_end_in_a_stop_before_the_line_with_the_stone) {
  ThrowRequest request = request_of(tee_draw);
  request.eyes = Eyes::oracle;
  request.fault = parse_fault(GetParam());
  ASSERT_TRUE(request.fault);
  const ThrowOutcome outcome = throw_stone(request, {});
  const ThrowResult& r = outcome.result;
  EXPECT_FALSE(r.ok);
  EXPECT_FALSE(r.release);
  EXPECT_FALSE(r.hog_line_violation);
  ASSERT_TRUE(r.abort);
  EXPECT_FALSE(r.abort->empty());
  ASSERT_FALSE(r.states.empty());
  EXPECT_EQ(r.states.back().name, "stopped");
  const ThrowSample& last = outcome.log.samples.back();
  EXPECT_TRUE(last.stone_held);
  EXPECT_LT(last.stone_y_m, hog_line_y_m - 0.145);
  EXPECT_NEAR(last.true_speed_mps, 0.0, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Table, Faults,
                         testing::Values("drive-heartbeat@1.0", "drive-dies@1.0", "camera-freeze@1.0",
                                         "camera-stops@1.0", "camera-black@1.0", "modbus-stop@1.0", "gyro-silent@1.0",
                                         "can-down@1.0"));

TEST(Throw, the_oracle_throws_as_well) {
  ThrowRequest request = request_of({"normal hit", 9, 2.54, 0.8, servo::Curl::counter_clockwise});
  request.eyes = Eyes::oracle;
  const ThrowResult r = throw_stone(request, {}).result;
  EXPECT_TRUE(r.ok) << result_line(r);
}

TEST(Throw, the_same_seed_gives_the_same_throw) {
  ThrowRequest request = request_of(tee_draw);
  request.fault = parse_fault("gyro-silent@0.3");
  const ThrowOutcome a = throw_stone(request, {});
  const ThrowOutcome b = throw_stone(request, {});
  EXPECT_EQ(result_line(a.result), result_line(b.result));
  ASSERT_EQ(a.log.samples.size(), b.log.samples.size());
  for (std::size_t i = 0; i < a.log.samples.size(); ++i) {
    ASSERT_EQ(a.log.samples[i].true_body.x_m, b.log.samples[i].true_body.x_m) << i;
    ASSERT_EQ(a.log.samples[i].believed_yaw_rad, b.log.samples[i].believed_yaw_rad) << i;
  }
}

}  // namespace
}  // namespace hogline
