#include "servo/heading_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

const Stamp start = Stamp(std::chrono::seconds(50));
constexpr double look_sigma = 0.001;

struct Look {
  Stamp stamp;
  Stamp arrives;
  double yaw;
};

struct Swing {
  std::vector<std::pair<Stamp, double>> gyro;
  std::vector<Look> looks;
  std::vector<double> yaw;  // true, at the gyro's stamps
};

/// A body that swings, seen at 60 Hz, each look `latency` late.
Swing swing(std::uint64_t seed, double bias, const GyroConfig& config, double least_s, double greatest_s) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Swing run;
  const double dt = seconds(period);
  double yaw = 0.1 * normal(random);
  double next_look = 0.0;
  for (int i = 1; i <= 1200; ++i) {
    const double t = i * dt;
    const double rate = 0.3 * std::sin(1.3 * t);
    yaw += 0.3 * (std::cos(1.3 * (t - dt)) - std::cos(1.3 * t)) / 1.3;
    const Stamp stamp = start + period * i;
    run.gyro.emplace_back(stamp, rate + bias + config.noise_rad_per_sqrt_s / std::sqrt(dt) * normal(random));
    run.yaw.push_back(yaw);
    if (t < next_look) continue;
    next_look += 1.0 / 60.0;
    if (uniform(random) < 0.1) continue;
    const double latency = least_s + (greatest_s - least_s) * uniform(random);
    run.looks.push_back({stamp, stamp + from_seconds(latency), yaw + look_sigma * normal(random)});
  }
  std::sort(run.looks.begin(), run.looks.end(), [](const Look& a, const Look& b) { return a.arrives < b.arrives; });
  return run;
}

TEST(HeadingFilter, IsConsistentWithLateMissingAndOutOfOrderLooks) {
  GyroConfig config = thrower_config().gyro;
  config.noise_rad_per_sqrt_s = 3e-4;
  double yaw_square = 0.0;
  double bias_square = 0.0;
  const int runs = 200;
  for (int seed = 1; seed <= runs; ++seed) {
    std::mt19937_64 random(1000 + seed);
    const double bias = config.bias_sigma_radps * std::normal_distribution<double>()(random);
    const Swing run = swing(seed, bias, config, 0.005, 0.080);
    HeadingFilter filter(config, start);
    filter.start(start, run.yaw.front(), 0.05);
    std::size_t next = 0;
    for (const auto& [stamp, rate] : run.gyro) {
      filter.gyro(stamp, rate, false);
      for (; next < run.looks.size() && run.looks[next].arrives <= stamp; ++next) {
        filter.sheet_yaw(run.looks[next].stamp, run.looks[next].yaw, look_sigma);
      }
    }
    const HeadingEstimate estimate = filter.at(run.gyro.back().first);
    yaw_square += std::pow((estimate.yaw_rad - run.yaw.back()) / estimate.yaw_sigma_rad, 2);
    bias_square += std::pow((estimate.bias_radps - bias) / estimate.bias_sigma_radps, 2);
    EXPECT_LT(estimate.yaw_sigma_rad, look_sigma);
    EXPECT_LE(filter.gated(), 2);
  }
  EXPECT_GT(std::sqrt(yaw_square / runs), 0.8);
  EXPECT_LT(std::sqrt(yaw_square / runs), 1.2);
  EXPECT_GT(std::sqrt(bias_square / runs), 0.8);
  EXPECT_LT(std::sqrt(bias_square / runs), 1.2);
}

TEST(HeadingFilter, LateAndShuffledLooksGiveWhatPromptOnesGive) {
  const GyroConfig config = thrower_config().gyro;
  const Swing run = swing(3, 0.004, config, 0.0, 0.2);
  std::vector<Look> prompt = run.looks;
  std::sort(prompt.begin(), prompt.end(), [](const Look& a, const Look& b) { return a.stamp < b.stamp; });
  for (Look& look : prompt) look.arrives = look.stamp;
  const auto feed = [&](const std::vector<Look>& looks) {
    HeadingFilter filter(config, start);
    filter.start(start, run.yaw.front(), 0.05);
    std::size_t next = 0;
    for (const auto& [stamp, rate] : run.gyro) {
      filter.gyro(stamp, rate, false);
      for (; next < looks.size() && looks[next].arrives <= stamp; ++next) {
        filter.sheet_yaw(looks[next].stamp, looks[next].yaw, look_sigma);
      }
    }
    for (; next < looks.size(); ++next) filter.sheet_yaw(looks[next].stamp, looks[next].yaw, look_sigma);
    return filter.at(run.gyro.back().first);
  };
  const HeadingEstimate late = feed(run.looks);
  const HeadingEstimate in_time = feed(prompt);
  EXPECT_NEAR(late.yaw_rad, in_time.yaw_rad, 1e-12);
  EXPECT_NEAR(late.bias_radps, in_time.bias_radps, 1e-12);
  EXPECT_NEAR(late.yaw_sigma_rad, in_time.yaw_sigma_rad, 1e-12);
}

TEST(HeadingFilter, LearnsTheBiasAtRest) {
  GyroConfig config = thrower_config().gyro;
  std::mt19937_64 random(5);
  const double noise = config.noise_rad_per_sqrt_s / std::sqrt(seconds(period));
  HeadingFilter filter(config, start);
  for (int i = 1; i <= 200; ++i) {
    filter.gyro(start + period * i, 0.006 + noise * std::normal_distribution<double>()(random), true);
  }
  const HeadingEstimate estimate = filter.at(start + period * 200);
  EXPECT_NEAR(estimate.bias_radps, 0.006, 4.0 * estimate.bias_sigma_radps);
  EXPECT_NEAR(estimate.bias_sigma_radps, config.noise_rad_per_sqrt_s, 0.1 * config.noise_rad_per_sqrt_s)
      << "one second of rest: the random walk over one second";
}

TEST(HeadingFilter, GatesWhatCanNotBeAndRecovers) {
  HeadingFilter filter(thrower_config().gyro, start);
  filter.start(start, 0.0, 0.001);
  for (int i = 1; i <= 100; ++i) filter.gyro(start + period * i, 0.0, true);
  EXPECT_EQ(filter.sheet_yaw(start + period * 50, 0.2, 0.001), Fusion::gated);
  EXPECT_EQ(filter.gated_in_a_row(), 1);
  EXPECT_NEAR(filter.at(start + period * 100).yaw_rad, 0.0, 1e-9);
  EXPECT_EQ(filter.sheet_yaw(start + period * 60, 0.0005, 0.001), Fusion::accepted);
  EXPECT_EQ(filter.gated_in_a_row(), 0);
  EXPECT_EQ(filter.sheet_yaw(start + period * 60, 0.0005, 0.001), Fusion::duplicate);
  EXPECT_EQ(filter.sheet_yaw(start - period, 0.0, 0.001), Fusion::too_old);
}

TEST(HeadingFilter, HeadingsWrap) {
  HeadingFilter filter(thrower_config().gyro, start);
  filter.start(start, 3.1415, 0.001);
  filter.gyro(start + period, 0.0, true);
  EXPECT_EQ(filter.sheet_yaw(start + period, -3.1415, 0.001), Fusion::accepted);
  EXPECT_GT(std::abs(filter.at(start + period).yaw_rad), 3.14);
}

TEST(HeadingFilter, DropsGyroSamplesThatGoBack) {
  HeadingFilter filter(thrower_config().gyro, start);
  filter.start(start, 0.0, 0.001);
  for (int i = 1; i <= 10; ++i) filter.gyro(start + period * i, 0.1, false);
  const double before = filter.at(start + period * 10).yaw_rad;
  filter.gyro(start + period * 5, 3.0, false);
  filter.gyro(start + period * 10, 3.0, false);
  EXPECT_EQ(filter.at(start + period * 10).yaw_rad, before);
}

}  // namespace
}  // namespace hogline::servo::test
