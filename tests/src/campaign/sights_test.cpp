// The oracle's figures are found again from errors that were made with known ones.
#include "src/campaign/sights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"

namespace hogline::campaign {
namespace {

constexpr double frame_s = 1.0 / 60.0;

// Both cameras see from 9 m to 8 m, all with the same errors of y; x and yaw are exact.
std::vector<Sighting> made_up(const SightError& y, double drift_time_s, double missing_share) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<Sighting> sightings;
  const double keep = std::exp(-frame_s / drift_time_s);
  for (int number = 0; number < 80; ++number) {
    for (const bool low : {false, true}) {
      const double bias = y.bias * normal(random);
      double drift = y.drift * normal(random);
      for (int frame = 0; frame < 300; ++frame) {
        drift = keep * drift + std::sqrt(1.0 - keep * keep) * y.drift * normal(random);
        Sighting s{.throw_number = number,
                   .low = low,
                   .t_s = frame * frame_s,
                   .hog_m = 8.9 - 0.8 * frame / 300.0,
                   .ok = true,
                   .error = {},
                   .claimed = {}};
        s.ok = frame == 0 || frame == 299 || uniform(random) >= missing_share;
        s.error.y_m = y.offset + bias + drift + y.noise * normal(random);
        s.claimed = {0.001, y.claimed, 0.001};
        sightings.push_back(s);
      }
    }
  }
  return sightings;
}

TEST(FitOracle, finds_what_the_errors_were_made_of) {
  const SightError made{.offset = 0.004, .bias = 0.003, .drift = 0.002, .noise = 0.001, .claimed = 0.005};
  const OracleQuality fitted = fit_oracle(made_up(made, 0.1, 0.1));
  ASSERT_GE(fitted.low.knots.size(), 3U);
  const SightKnot& knot = fitted.low.knots[1];
  EXPECT_NEAR(knot.y.offset, made.offset, 0.001);
  EXPECT_NEAR(knot.y.bias, made.bias, 0.0007);
  EXPECT_NEAR(knot.y.drift, made.drift, 0.0004);
  EXPECT_NEAR(knot.y.noise, made.noise, 0.0002);
  EXPECT_EQ(knot.y.claimed, made.claimed);
  EXPECT_NEAR(knot.missing_share, 0.1, 0.01);
  EXPECT_NEAR(fitted.low.drift_time_s, 0.1, 0.05);
  EXPECT_NEAR(fitted.low.missing_frames, 1.1, 0.1);
  EXPECT_EQ(knot.x.bias, 0.0);
}

TEST(FitOracle, noise_alone_is_neither_bias_nor_drift) {
  const SightError made{.offset = 0.0, .bias = 0.0, .drift = 0.0, .noise = 0.002, .claimed = 0.002};
  const SightKnot knot = fit_oracle(made_up(made, 0.1, 0.0)).near.knots[1];
  EXPECT_LT(knot.y.bias, 0.0003);
  EXPECT_LT(knot.y.drift, 0.0007);
  EXPECT_NEAR(knot.y.noise, 0.002, 0.0003);
  EXPECT_EQ(knot.missing_share, 0.0);
}

TEST(FitOracle, a_distance_that_is_not_measured_has_no_errors) {
  const SightError made{.offset = 0.5, .bias = 0.5, .drift = 0.0, .noise = 0.5, .claimed = 10.0};
  const SightKnot knot = fit_oracle(made_up(made, 0.1, 0.0)).low.knots[1];
  EXPECT_EQ(knot.y.bias, 0.0);
  EXPECT_EQ(knot.y.noise, 0.0);
  EXPECT_EQ(knot.y.claimed, 10.0);
}

TEST(OracleFile, comes_back_as_it_was_written) {
  const OracleQuality quality = measured_quality();
  const std::string text = oracle_text(quality, "two\nlines");
  EXPECT_EQ(text.substr(0, 14), "# two\n# lines\n");
  const OracleQuality back = parse_oracle(text, "again.yaml");
  EXPECT_EQ(oracle_text(back, "two\nlines"), text);
}

TEST(OracleFile, knots_out_of_order_and_unknown_keys_are_refused) {
  OracleQuality quality = measured_quality();
  std::swap(quality.low.knots.front(), quality.low.knots.back());
  EXPECT_THROW(parse_oracle(oracle_text(quality, ""), "my.yaml"), config::ConfigError);
  std::string text = oracle_text(measured_quality(), "");
  text.replace(text.find("missing_share"), 13, "missing_chair");
  EXPECT_THROW(parse_oracle(text, "my.yaml"), config::ConfigError);
}

}  // namespace
}  // namespace hogline::campaign
