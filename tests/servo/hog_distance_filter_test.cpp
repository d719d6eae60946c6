#include "servo/hog_distance_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "servo/speed_profile.hpp"
#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

const Stamp start = Stamp(std::chrono::seconds(50));
constexpr double plane_m = 1.0;

struct Settings {
  double scale_error = 0.01;
  double missing = 0.1;
  double greatest_latency_s = 0.040;
  double sigma_m = 0.010;
  double visible_to_m = 0.68;
  bool outliers = false;
  double start_m = 9.0;
  double encoder_sigma_mps = 0.0;
  double slip = 0.0;          // the wheels turn faster than the body by this share ...
  double slip_from_m = 4.0;   // ... from this distance on ...
  double slip_time_s = 0.15;  // ... for so long
};

struct Result {
  double speed_gained_mps = 0.0;  // from the prediction to the plane
  double speed_error_mps = 0.0;
  double acceleration_error_mps2 = 0.0;
  double crossing_error_s = 0.0;
  double crossing_sigma_s = 0.0;
  double distance_error_m = 0.0;  // at the plane
  double distance_sigma_m = 0.0;
  double scale_error = 0.0;
  double scale_sigma = 0.0;
  int gated = 0;
  int out_of_order = 0;  // looks that arrived after a younger one
};

struct Look {
  Stamp stamp;
  Stamp arrives;
  double hog_distance_m;
};

/// How long a body on this profile needs for a distance from a time on, and how much faster it then is.
struct Way {
  double time_s = 0.0;
  double gained_mps = 0.0;
};

Way way_of(const SpeedProfile& profile, double from_s, double distance_m) {
  constexpr double step_s = 1e-5;
  double t = from_s;
  for (; distance_m > 0.0; t += step_s) distance_m -= step_s * profile.speed_mps(t + 0.5 * step_s);
  return {t - from_s, profile.speed_mps(t) - profile.speed_mps(from_s)};
}

/// A run along the sheet; the crossing is predicted 80 ms ahead of the plane.
Result run(std::uint64_t seed, double speed_mps, const Settings& settings) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const OdometryConfig config = thrower_config().odometry;
  const SpeedProfile profile(speed_mps, 1.0, 3.0);
  const double true_scale = 1.0 + settings.scale_error;
  const double dt = seconds(period);
  HogDistanceFilter filter(config, start, settings.start_m + 0.005 * normal(random), 0.005);
  std::vector<Look> under_way;
  double distance = settings.start_m;
  double slipping_s = 0.0;
  double t_end = 0.0;
  double next_look = 0.0;
  Stamp youngest = start;
  Result result;
  for (int i = 1; distance > plane_m + profile.speed_mps(t_end) * 0.080; ++i) {
    const double t = i * dt;
    t_end = t;
    const Stamp now = start + period * i;
    const double slip = config.noise_m_per_sqrt_m * normal(random);
    const double before = profile.speed_mps(t - dt);
    const double after = profile.speed_mps(t);
    distance -= (before + after) / 2.0 * dt + slip * std::sqrt((before + after) / 2.0 * dt);
    const bool slips = distance < settings.slip_from_m && slipping_s < settings.slip_time_s;
    if (slips) slipping_s += dt;
    const double turned = after * (slips ? 1.0 + settings.slip : 1.0);
    filter.odometry(now, turned / true_scale + settings.encoder_sigma_mps * normal(random), 0.0);
    if (t >= next_look) {
      next_look += 1.0 / 60.0;
      const double wild = settings.outliers && uniform(random) < 0.1 ? 0.4 : 0.0;
      const double latency = settings.greatest_latency_s * uniform(random);
      const double seen = distance + settings.sigma_m * normal(random) + wild;
      const bool missing = uniform(random) < settings.missing || distance > 6.5 || distance < settings.visible_to_m;
      if (!missing) under_way.push_back({now, now + from_seconds(latency), seen});
    }
    for (auto look = under_way.begin(); look != under_way.end();) {
      if (look->arrives > now) {
        ++look;
        continue;
      }
      if (look->stamp < youngest) ++result.out_of_order;
      youngest = std::max(youngest, look->stamp);
      filter.hog_distance(look->stamp, look->hog_distance_m, settings.sigma_m);
      look = under_way.erase(look);
    }
    const auto crossing = filter.crossing(now, plane_m);
    const HogDistanceEstimate estimate = filter.at(now);
    if (crossing && distance < plane_m + after * 0.090) {
      const Way way = way_of(profile, t, distance - plane_m);
      result.crossing_error_s = seconds(crossing->stamp - now) - way.time_s;
      result.speed_gained_mps = way.gained_mps;
    }
    if (crossing) result.crossing_sigma_s = crossing->sigma_s;
    result.speed_error_mps = estimate.speed_mps - after;
    result.acceleration_error_mps2 = estimate.acceleration_mps2 - profile.acceleration_mps2(t);
    result.distance_error_m = estimate.hog_distance_m - distance;
    result.distance_sigma_m = estimate.hog_distance_sigma_m;
    result.scale_error = estimate.scale - true_scale;
    result.scale_sigma = estimate.scale_sigma;
  }
  result.gated = filter.gated();
  return result;
}

class AnySeries : public ::testing::TestWithParam<int> {};

// The wheel's radius 1 % wrong either way, frames up to 40 ms late and so in any order, every tenth missing.
TEST_P(AnySeries, PredictsTheCrossingWithAnHonestSigma) {
  Settings settings;
  int out_of_order = 0;
  double square_s = 0.0;
  double normalised_crossing = 0.0;
  double normalised_distance = 0.0;
  double normalised_scale = 0.0;
  double sum_s = 0.0;
  const int runs = 200;
  for (int seed = 1; seed <= runs; ++seed) {
    settings.scale_error = seed % 2 == 0 ? 0.01 : -0.01;
    const Result r = run(static_cast<std::uint64_t>(1000 * GetParam() + seed), 1.8 + 1.7 * seed / runs, settings);
    out_of_order += r.out_of_order;
    square_s += r.crossing_error_s * r.crossing_error_s;
    sum_s += r.crossing_error_s;
    normalised_crossing += std::pow(r.crossing_error_s / r.crossing_sigma_s, 2);
    normalised_distance += std::pow(r.distance_error_m / r.distance_sigma_m, 2);
    normalised_scale += std::pow(r.scale_error / r.scale_sigma, 2);
  }
  RecordProperty("crossing_rms_us", static_cast<int>(1e6 * std::sqrt(square_s / runs)));
  EXPECT_LT(std::sqrt(square_s / runs), 0.003);
  EXPECT_LT(std::abs(sum_s / runs), 0.0005) << "no bias";
  EXPECT_GT(std::sqrt(normalised_crossing / runs), 0.8);
  EXPECT_LT(std::sqrt(normalised_crossing / runs), 1.3);
  EXPECT_GT(std::sqrt(normalised_distance / runs), 0.8);
  EXPECT_LT(std::sqrt(normalised_distance / runs), 1.3);
  EXPECT_LT(std::sqrt(normalised_scale / runs), 1.3);
  EXPECT_GT(out_of_order, 10 * runs) << "frames that overtook others were among them";
}

INSTANTIATE_TEST_SUITE_P(HogDistanceFilter, AnySeries, ::testing::Range(0, 5));

TEST(HogDistanceFilter, PredictsTheCrossingOfABodyThatStillAccelerates) {
  Settings settings;
  settings.encoder_sigma_mps = 0.003;
  double square_s = 0.0;
  double sum_s = 0.0;
  double normalised = 0.0;
  double acceleration = 0.0;
  const int runs = 200;
  for (int seed = 1; seed <= runs; ++seed) {
    const double speed_mps = 1.8 + 1.7 * seed / runs;
    settings.scale_error = seed % 2 == 0 ? 0.01 : -0.01;
    settings.start_m = plane_m + 0.8 * SpeedProfile(speed_mps, 1.0, 3.0).distance_m();
    const Result r = run(seed, speed_mps, settings);
    ASSERT_GT(r.speed_gained_mps, 0.04) << "at half of the greatest acceleration or more";
    square_s += r.crossing_error_s * r.crossing_error_s;
    sum_s += r.crossing_error_s;
    normalised += std::pow(r.crossing_error_s / r.crossing_sigma_s, 2);
    acceleration += std::pow(r.acceleration_error_mps2, 2);
  }
  RecordProperty("crossing_rms_us", static_cast<int>(1e6 * std::sqrt(square_s / runs)));
  EXPECT_LT(std::sqrt(square_s / runs), 0.003);
  EXPECT_LT(std::abs(sum_s / runs), 0.0005) << "no bias: at constant speed it would be 1 ms";
  EXPECT_GT(std::sqrt(normalised / runs), 0.8);
  EXPECT_LT(std::sqrt(normalised / runs), 1.3);
  EXPECT_LT(std::sqrt(acceleration / runs), 0.2);
}

TEST(HogDistanceFilter, FindsThePlaceAgainAfterTheWheelsHaveSlipped) {
  Settings settings;
  for (const double slip : {-0.08, 0.08}) {
    settings.slip = slip;
    double square_s = 0.0;
    double normalised = 0.0;
    const int runs = 100;
    for (int seed = 1; seed <= runs; ++seed) {
      const Result r = run(seed, 1.8 + 1.7 * seed / runs, settings);
      square_s += r.crossing_error_s * r.crossing_error_s;
      normalised += std::pow(r.crossing_error_s / r.crossing_sigma_s, 2);
    }
    EXPECT_LT(std::sqrt(square_s / runs), 0.003) << "slip " << slip;
    EXPECT_LT(std::sqrt(normalised / runs), 1.5) << "slip " << slip;
  }
}

TEST(HogDistanceFilter, LooksInAnyOrderGiveTheSameEstimate) {
  const auto filled = [](const std::vector<int>& order) {
    HogDistanceFilter filter(thrower_config().odometry, start, 5.0, 0.05);
    for (int i = 1; i <= 60; ++i) filter.odometry(start + period * i, 2.0 + 0.001 * i, 0.0);
    for (const int i : order) {
      filter.hog_distance(start + period * i, 5.0 - 0.0102 * i + (i % 3 - 1) * 0.006, 0.008);
    }
    return filter.at(start + period * 60);
  };
  const HogDistanceEstimate in_order = filled({5, 12, 20, 31, 44, 52});
  const HogDistanceEstimate shuffled = filled({20, 5, 52, 12, 44, 31});
  EXPECT_NEAR(shuffled.hog_distance_m, in_order.hog_distance_m, 1e-12);
  EXPECT_NEAR(shuffled.hog_distance_sigma_m, in_order.hog_distance_sigma_m, 1e-12);
  EXPECT_NEAR(shuffled.scale, in_order.scale, 1e-12);
}

TEST(HogDistanceFilter, ABodyThatBrakesMayNotReachThePlane) {
  HogDistanceFilter filter(thrower_config().odometry, start, 2.0, 0.01);
  int i = 0;
  while (++i <= 100) filter.odometry(start + period * i, 0.4, 0.0);
  EXPECT_TRUE(filter.crossing(start + period * 100, plane_m).has_value());
  for (double speed = 0.4; speed > 0.2; speed -= 0.005) filter.odometry(start + period * i++, speed, 0.0);
  EXPECT_NEAR(filter.at(start + period * (i - 1)).acceleration_mps2, -1.0, 0.1);
  EXPECT_FALSE(filter.crossing(start + period * (i - 1), plane_m).has_value());
}

TEST(HogDistanceFilter, DeadReckonsWhenTheLineHasLeftThePicture) {
  Settings settings;
  settings.visible_to_m = 2.0;
  for (int seed = 1; seed <= 20; ++seed) {
    const Result blind = run(seed, 2.5, settings);
    EXPECT_LT(std::abs(blind.distance_error_m), 4.0 * blind.distance_sigma_m);
    EXPECT_GT(blind.distance_sigma_m, run(seed, 2.5, Settings{}).distance_sigma_m) << "and says that it knows less";
  }
}

TEST(HogDistanceFilter, OutliersAreGatedAndCounted) {
  Settings settings;
  settings.outliers = true;
  for (int seed = 1; seed <= 20; ++seed) {
    const Result r = run(seed, 2.5, settings);
    EXPECT_GT(r.gated, 3);
    EXPECT_LT(std::abs(r.crossing_error_s), 0.008);
  }
}

// Sure of the place to half a millimetre; then the wheels lose way little by little, as studs do that creep.
TEST(HogDistanceFilter, LooksThatAgreeWithEachOtherAreBelievedAgain) {
  constexpr double sigma_m = 0.0006;
  for (const double lost : {-0.02, -0.01, 0.01, 0.02}) {
    HogDistanceFilter filter(thrower_config().odometry, start, 9.0, 0.003);
    double distance = 9.0;
    int i = 0;
    int longest = 0;
    const auto drive = [&](int until, double share, bool seen) {
      while (++i <= until) {
        distance -= 1.5 * seconds(period);
        filter.odometry(start + period * i, 1.5 * (1.0 + share), 0.0);
        if (seen && i % 3 == 0) filter.hog_distance(start + period * i, distance, sigma_m);
        longest = std::max(longest, filter.gated_in_a_row());
      }
      --i;
    };
    drive(300, 0.0, true);
    drive(360, lost, false);  // ... behind somebody's legs
    drive(500, lost, true);
    const HogDistanceEstimate estimate = filter.at(start + period * 500);
    EXPECT_LT(longest, 6) << "lost " << lost;
    EXPECT_NEAR(estimate.hog_distance_m, distance, 4.0 * estimate.hog_distance_sigma_m) << "lost " << lost;
    EXPECT_NEAR(estimate.scale, 1.0 / (1.0 + lost), 0.002) << "lost " << lost;
  }
}

TEST(HogDistanceFilter, WhatNoSlipExplainsStaysRefused) {
  HogDistanceFilter filter(thrower_config().odometry, start, 9.0, 0.003);
  for (int i = 1; i <= 100; ++i) {
    filter.odometry(start + period * i, 1.5, 0.0);
    const double distance = 9.0 - 1.5 * seconds(period) * i;
    if (i % 3 == 0) filter.hog_distance(start + period * i, distance + (i > 40 ? 0.3 : 0.0), 0.001);
  }
  EXPECT_EQ(filter.gated_in_a_row(), 20);
  EXPECT_NEAR(filter.at(start + period * 100).hog_distance_m, 9.0 - 0.75, 0.005);
}

TEST(HogDistanceFilter, LooksThatShareAnErrorAreWorthLittleMoreThanOneOfThem) {
  const auto sigma_after = [](double counts_as) {
    HogDistanceFilter filter(thrower_config().odometry, start, 9.0, 1.0);
    for (int i = 1; i <= 60; ++i) {
      filter.odometry(start + period * i, 0.0, 0.0);
      filter.hog_distance(start + period * i, 9.0, 0.006, counts_as);
    }
    return filter.at(start + period * 60).hog_distance_sigma_m;
  };
  EXPECT_NEAR(sigma_after(1.0), 0.006 / std::sqrt(60.0), 1e-5);
  EXPECT_GT(sigma_after(1.0 / 60.0), 0.006 / 2.0);
  EXPECT_LT(sigma_after(1.0 / 60.0), 0.006);
}

TEST(HogDistanceFilter, LooksActAtTheirOwnStamp) {
  HogDistanceFilter filter(thrower_config().odometry, start, 5.0, 0.05);
  for (int i = 1; i <= 100; ++i) filter.odometry(start + period * i, 2.0, 0.0);
  const double before = filter.at(start + period * 100).hog_distance_m;
  const double at_80 = filter.at(start + period * 80).hog_distance_m;
  EXPECT_NEAR(at_80 - before, 0.2, 1e-9);
  EXPECT_EQ(filter.hog_distance(start + period * 80, at_80, 0.005), Fusion::accepted);
  EXPECT_NEAR(filter.at(start + period * 100).hog_distance_m, before, 1e-9) << "what was believed is confirmed";
  EXPECT_EQ(filter.hog_distance(start + period * 80, at_80, 0.005), Fusion::duplicate);
  EXPECT_EQ(filter.hog_distance(start - period, at_80, 0.005), Fusion::too_old);
}

TEST(HogDistanceFilter, ARunAtAnAngleCoversLessOfTheSheet) {
  HogDistanceFilter filter(thrower_config().odometry, start, 5.0, 0.01);
  filter.odometry(start + period, 2.0, 0.3);
  EXPECT_NEAR(filter.at(start + period).speed_mps, 2.0 * std::cos(0.3), 1e-12);
}

TEST(HogDistanceFilter, ABodyThatStandsCrossesNothing) {
  HogDistanceFilter filter(thrower_config().odometry, start, 5.0, 0.01);
  EXPECT_FALSE(filter.crossing(start, plane_m).has_value());
  filter.odometry(start + period, -1.0, 0.0);
  EXPECT_FALSE(filter.crossing(start + period, plane_m).has_value()) << "nor one that moves away";
}

TEST(HogDistanceFilter, APlaneBehindHasBeenCrossedBefore) {
  HogDistanceFilter filter(thrower_config().odometry, start, 0.8, 0.01);
  for (int i = 1; i <= 10; ++i) filter.odometry(start + period * i, 2.0, 0.0);
  EXPECT_LT(filter.crossing(start + period * 10, plane_m)->stamp, start + period * 10);
}

}  // namespace
}  // namespace hogline::servo::test
