// What the gyro adapter makes of a good device: mode, stamps, sign, earth, bias, either variant, any rate within 3 %.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/hw/dsp3000/gyro_bench.hpp"

namespace hogline::hw {
namespace {

class EitherVariant : public testing::TestWithParam<Dsp3000Variant> {};

TEST_P(EitherVariant, gives_the_rate_in_the_bodys_sense_at_the_moment_it_was_measured) {
  auto config = gyro_config(GetParam());
  config.sign = -1.0;
  GyroBench bench(config, gyro_scenario(GetParam()));
  bench.resting = false;
  bench.run(200ms);
  // A rate that rises evenly shows what moment a reading belongs to.
  const double slope_radps2 = 50.0 * degree;
  const Stamp start = bench.now;
  for (int i = 0; i < 100; ++i) {
    bench.step(slope_radps2 * seconds(bench.now + 5ms - start));
    if (i < 20) continue;
    const auto state = bench.gyro.state();
    ASSERT_TRUE(state.valid);
    const double noise = 6.0 * 0.067 / 60.0 * degree / std::sqrt(1e-3);
    EXPECT_NEAR(state.rate_radps, -slope_radps2 * seconds(state.stamp - start), noise);
    EXPECT_LE(seconds(bench.now - state.stamp), 0.014);
  }
  EXPECT_EQ(bench.error(), "");
}

TEST_P(EitherVariant, asks_for_rate_mode_and_believes_nothing_before_readings_agree) {
  GyroBench bench(GetParam());
  bench.device.set_mode(sim::GyroDevice::Mode::integrated_angle);
  bench.step();
  EXPECT_EQ(bench.line.asked, "R");
  EXPECT_FALSE(bench.gyro.verified());
  EXPECT_FALSE(bench.gyro.state().valid);
  bench.run(100ms);
  EXPECT_TRUE(bench.gyro.verified());
  EXPECT_TRUE(bench.gyro.state().valid);
  EXPECT_EQ(bench.line.asked, "R") << "once is enough";
}

TEST_P(EitherVariant, asks_again_when_the_letter_was_lost) {
  GyroBench bench(GetParam());
  bench.device.set_silent(true);
  bench.device.set_deaf(true);
  bench.run(150ms);
  bench.device.set_deaf(false);
  bench.device.set_silent(false);
  bench.run(200ms);
  EXPECT_GE(bench.line.asked.size(), 2U);
  EXPECT_TRUE(bench.gyro.verified());
  EXPECT_EQ(bench.error(), "");
}

TEST_P(EitherVariant, integrates_to_the_true_angle_with_any_clock_within_three_per_cent) {
  for (const double clock : {0.97, 1.0, 1.03}) {
    auto scenario = gyro_scenario(GetParam());
    scenario.line_rate_hz *= clock;
    scenario.bias_radps = 0.0;
    GyroBench bench(gyro_config(GetParam()), scenario);
    bench.resting = false;
    bench.run(200ms);
    // Trapezoids between the stamps, as a heading filter does it.
    double angle_rad = 0.0;
    auto last = bench.gyro.state();
    const Stamp first = last.stamp;
    for (int i = 0; i < 2000; ++i) {
      bench.step(20.0 * degree * std::sin(2.0 * seconds(bench.now + 5ms - first)));
      const auto state = bench.gyro.state();
      angle_rad += 0.5 * (state.rate_radps + last.rate_radps) * seconds(state.stamp - last.stamp);
      last = state;
    }
    const double true_rad = 10.0 * degree * (1.0 - std::cos(2.0 * seconds(last.stamp - first)));
    EXPECT_NEAR(angle_rad, true_rad, 0.05 * degree) << clock;
    EXPECT_EQ(bench.error(), "") << clock;
    ASSERT_TRUE(bench.gyro.readings_per_s());
    EXPECT_NEAR(*bench.gyro.readings_per_s() / scenario.line_rate_hz, 1.0, 0.011) << clock;
  }
}

TEST_P(EitherVariant, removes_the_earths_rate_in_either_hemisphere_and_estimates_the_bias_at_rest) {
  for (const double latitude_deg : {-45.0, 0.0, 37.8, 68.0}) {
    auto config = gyro_config(GetParam());
    auto scenario = gyro_scenario(GetParam());
    config.latitude_rad = scenario.latitude_rad = latitude_deg * degree;
    GyroBench bench(config, scenario);
    EXPECT_FALSE(bench.gyro.state().bias);
    bench.run(30s);
    const auto bias = bench.gyro.state().bias;
    ASSERT_TRUE(bias);
    // 0.067 deg/sqrt(h) over 30 s leaves 0.73 deg/h.
    EXPECT_NEAR(bias->radps * 3600.0 / degree, 6.0, 3.0) << latitude_deg;
    EXPECT_NEAR(bias->sigma_radps * 3600.0 / degree, 0.73, 0.2) << latitude_deg;
    EXPECT_EQ(bench.error(), "");
  }
}

INSTANTIATE_TEST_SUITE_P(variants, EitherVariant, testing::Values(Dsp3000Variant::text, Dsp3000Variant::binary),
                         [](const auto& variant) { return variant.param == Dsp3000Variant::text ? "text" : "binary"; });

TEST(Dsp3000Bias, nothing_is_learned_while_the_body_may_turn) {
  GyroBench bench;
  bench.resting = false;
  bench.run(5s, 10.0 * degree);
  EXPECT_FALSE(bench.gyro.state().bias);
  EXPECT_EQ(bench.error(), "");
}

TEST(Dsp3000Bias, one_bump_at_rest_is_not_a_step) {
  GyroBench bench;
  bench.run(5s);
  bench.run(200ms, 2.0 * degree);
  bench.run(5s);
  EXPECT_EQ(bench.error(), "");
  EXPECT_NEAR(bench.gyro.state().bias->radps * 3600.0 / degree, 6.0, 5.0);
}

}  // namespace
}  // namespace hogline::hw
