#include "servo/ice_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "tests/servo/ice_session.hpp"

namespace hogline::servo::test {
namespace {

constexpr int sessions = 100;

double sigma(const IceEstimate& e, std::size_t i) { return std::sqrt(e.covariance[4 * i]); }

ShotOrder draw(double speed_mps, Curl curl) {
  return {speed_mps, curl == Curl::counter_clockwise ? -0.03 : 0.03, curl, 1.57};
}

/// A draw of about the right weight: what a first throw on unknown ice is.
double draw_speed(const SheetOfIce& sheet) { return 2.2 * std::sqrt(sheet.ice.friction_scale); }

/// The ice changes for good from throw to throw, as the model expects.
void wear(SheetOfIce& sheet, std::mt19937_64& random) {
  const IceModelConfig config;
  std::normal_distribution<double> normal;
  sheet.ice.friction_scale += config.friction_drift * normal(random);
  sheet.ice.curl_gain += config.curl_drift * normal(random);
  sheet.ice.lateral_mps2 += config.lateral_drift_mps2 * normal(random);
}

struct Sums {
  double square = 0.0;
  double worst = 0.0;
  int count = 0;
  void add(double value) {
    square += value * value;
    worst = std::max(worst, std::abs(value));
    ++count;
  }
  double rms() const { return std::sqrt(square / count); }
};

TEST(IceModel, KnowsTheIceAfterTwoDrawsAndAimsTheThird) {
  Sums friction, curl, friction_normal, curl_normal, lateral_normal, miss, miss_normal;
  for (int session = 0; session < sessions; ++session) {
    std::mt19937_64 random(static_cast<std::uint64_t>(1000 + session));
    SheetOfIce sheet = unknown_sheet(random);
    IceModel model({}, {.throw_friction_sigma = 0.003});
    for (const Curl turn : {Curl::counter_clockwise, Curl::clockwise}) {
      const ThrowFit fit = model.learn(deliver(draw(draw_speed(sheet), turn), sheet, random).track);
      ASSERT_TRUE(fit.ok) << fit.reason << " in session " << session;
      if (model.estimate().throws == 1) wear(sheet, random);
    }
    const IceEstimate& ice = model.estimate();
    friction.add(ice.friction_scale / sheet.ice.friction_scale - 1.0);
    curl.add(ice.curl_gain / sheet.ice.curl_gain - 1.0);
    friction_normal.add((ice.friction_scale - sheet.ice.friction_scale) / sigma(ice, 0));
    curl_normal.add((ice.curl_gain - sheet.ice.curl_gain) / sigma(ice, 1));
    lateral_normal.add((ice.lateral_mps2 - sheet.ice.lateral_mps2) / sigma(ice, 2));

    const ShotAim aim = aim_shot({.rest = {0.5, far_tee_m - 1.0}}, robot(), model);
    ASSERT_TRUE(aim.ok) << aim.reason;
    wear(sheet, random);
    const Delivery third = deliver(aim.order, sheet, random);
    const double dx = third.rest.x_m - 0.5, dy = third.rest.y_m - far_tee_m + 1.0;
    miss.add(std::hypot(dx, dy));
    miss_normal.add(dy / std::sqrt(aim.covariance.yy_m2));
  }
  std::printf("%d sessions: friction %.2f %% RMS, %.2f %% at worst; curl %.2f %%, %.2f %%; the third draw %.3f m RMS\n",
              sessions, 100.0 * friction.rms(), 100.0 * friction.worst, 100.0 * curl.rms(), 100.0 * curl.worst,
              miss.rms());
  EXPECT_LT(friction.worst, 0.01);
  EXPECT_LT(curl.worst, 0.05);
  EXPECT_LT(miss.rms(), 0.3);
  for (const Sums* s : {&friction_normal, &curl_normal, &lateral_normal, &miss_normal}) {
    EXPECT_GT(s->rms(), 0.8);
    EXPECT_LT(s->rms(), 1.3);
  }
}

TEST(IceModel, ForetellsTheStopFromTheFirstPartOfTheWay) {
  Sums along, across;
  for (int session = 0; session < 40; ++session) {
    std::mt19937_64 random(static_cast<std::uint64_t>(2000 + session));
    const SheetOfIce sheet = unknown_sheet(random);
    Delivery throw_ = deliver(draw(draw_speed(sheet), Curl::clockwise), sheet, random);
    throw_.track.looks.resize(throw_.track.looks.size() * 6 / 10);
    IceModel model({}, {.throw_friction_sigma = 0.003});
    const ThrowFit fit = model.learn(throw_.track);
    ASSERT_TRUE(fit.ok) << fit.reason;
    const StopPrediction stop = predict_stop(fit.stone, fit.ice, fit.covariance);
    along.add((stop.y_m - throw_.rest.y_m) / std::sqrt(stop.covariance.yy_m2));
    across.add((stop.x_m - throw_.rest.x_m) / std::sqrt(stop.covariance.xx_m2));
  }
  for (const Sums* s : {&along, &across}) {
    EXPECT_GT(s->rms(), 0.75);
    EXPECT_LT(s->rms(), 1.35);
  }
}

TEST(IceModel, EveryThrowMakesItSurer) {
  std::mt19937_64 random(5);
  const SheetOfIce sheet = unknown_sheet(random);
  IceModel model({});
  double before = sigma(model.estimate(), 0);
  for (int i = 0; i < 4; ++i) {
    const Curl turn = i % 2 == 0 ? Curl::clockwise : Curl::counter_clockwise;
    ASSERT_TRUE(model.learn(deliver(draw(draw_speed(sheet), turn), sheet, random).track).ok);
    EXPECT_LT(sigma(model.estimate(), 0), before);
    EXPECT_EQ(model.estimate().throws, i + 1);
    before = sigma(model.estimate(), 0);
  }
}

TEST(IceModel, LooksThatAreElsewhereDoNotSpoilIt) {
  std::mt19937_64 random(6);
  const SheetOfIce sheet = unknown_sheet(random);
  Delivery throw_ = deliver(draw(draw_speed(sheet), Curl::clockwise), sheet, random);
  IceModel clean({}), spoilt({});
  ASSERT_TRUE(clean.learn(throw_.track).ok);
  for (std::size_t i = 20; i < throw_.track.looks.size(); i += 12) throw_.track.looks[i].x_m += 1.1;
  const ThrowFit fit = spoilt.learn(throw_.track);
  ASSERT_TRUE(fit.ok) << fit.reason;
  EXPECT_GT(fit.rejected, 40);
  EXPECT_NEAR(spoilt.estimate().friction_scale, clean.estimate().friction_scale, sigma(clean.estimate(), 0));
  EXPECT_NEAR(spoilt.estimate().curl_gain, clean.estimate().curl_gain, sigma(clean.estimate(), 1));
}

TEST(IceModel, SaysWhenTheLooksAreWorseThanTheyClaim) {
  std::mt19937_64 random(7);
  const SheetOfIce sheet = unknown_sheet(random);
  Delivery throw_ = deliver(draw(draw_speed(sheet), Curl::clockwise), sheet, random);
  const ThrowFit honest = fit_throw(throw_.track, IceModel({}).estimate(), {});
  for (TrackLook& look : throw_.track.looks) {
    for (double* c : {&look.covariance.xx_m2, &look.covariance.xy_m2, &look.covariance.yy_m2}) *c /= 4.0;
  }
  const ThrowFit boastful =
      fit_throw(throw_.track, IceModel({}).estimate(), {.suspicious_sigmas = 8.0, .rejected_sigmas = 12.0});
  ASSERT_TRUE(honest.ok && boastful.ok);
  EXPECT_NEAR(honest.residual, 1.0, 0.1);
  EXPECT_NEAR(boastful.residual, 2.0, 0.2);
  EXPECT_GT(boastful.covariance(0, 0), 0.7 * honest.covariance(0, 0));
}

TEST(IceModel, IsSavedAndGoesOn) {
  std::mt19937_64 random(8);
  const SheetOfIce sheet = unknown_sheet(random);
  IceModel first({});
  ASSERT_TRUE(first.learn(deliver(draw(2.2, Curl::clockwise), sheet, random).track).ok);
  const IceEstimate saved = first.estimate();
  ASSERT_FALSE(refusal(saved));
  IceModel second({}, saved);
  const ThrowTrack next = deliver(draw(2.2, Curl::counter_clockwise), sheet, random).track;
  first.learn(next);
  second.learn(next);
  EXPECT_EQ(first.estimate().friction_scale, second.estimate().friction_scale);
  EXPECT_EQ(first.estimate().covariance, second.estimate().covariance);
}

struct BadTrack {
  const char* name;
  void (*spoil)(ThrowTrack&);
};

class TracksThatTellNothing : public testing::TestWithParam<BadTrack> {};

TEST_P(TracksThatTellNothing, LeaveTheIceAsItWas) {
  std::mt19937_64 random(9);
  ThrowTrack track = deliver(draw(2.2, Curl::clockwise), unknown_sheet(random), random).track;
  GetParam().spoil(track);
  IceModel model({});
  const ThrowFit fit = model.learn(track);
  EXPECT_FALSE(fit.ok);
  EXPECT_FALSE(fit.reason.empty());
  EXPECT_EQ(model.estimate().throws, 0);
  EXPECT_EQ(model.estimate().friction_scale, 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    Each, TracksThatTellNothing,
    testing::Values(
        BadTrack{"empty", [](ThrowTrack& track) { track.looks.clear(); }},
        BadTrack{"few", [](ThrowTrack& track) { track.looks.resize(5); }},
        BadTrack{"stands", [](ThrowTrack& track) { track.looks.erase(track.looks.begin(), track.looks.end() - 14); }},
        BadTrack{"nan", [](ThrowTrack& track) { track.looks[3].x_m = std::numeric_limits<double>::quiet_NaN(); }},
        BadTrack{"no_covariance", [](ThrowTrack& track) { track.looks[3].covariance = {}; }},
        BadTrack{"disorder", [](ThrowTrack& track) { std::swap(track.looks[3].stamp, track.looks[4].stamp); }},
        BadTrack{"noise",
                 [](ThrowTrack& track) {
                   std::mt19937_64 random(1);
                   std::uniform_real_distribution<double> x(-2.0, 2.0), y(10.0, 40.0);
                   for (TrackLook& l : track.looks) l.x_m = x(random), l.y_m = y(random);
                 }}),
    [](const auto& bad) { return std::string(bad.param.name); });

struct BadIce {
  const char* name;
  void (*spoil)(IceEstimate&);
};

class EstimatesThatAreNone : public testing::TestWithParam<BadIce> {};

TEST_P(EstimatesThatAreNone, AreRefused) {
  IceEstimate estimate = IceModel({}).estimate();
  ASSERT_FALSE(refusal(estimate));
  GetParam().spoil(estimate);
  EXPECT_TRUE(refusal(estimate));
}

INSTANTIATE_TEST_SUITE_P(
    Each, EstimatesThatAreNone,
    testing::Values(BadIce{"friction", [](IceEstimate& e) { e.friction_scale = 0.0; }},
                    BadIce{"nan", [](IceEstimate& e) { e.curl_gain = std::numeric_limits<double>::quiet_NaN(); }},
                    BadIce{"lateral", [](IceEstimate& e) { e.lateral_mps2 = 0.1; }},
                    BadIce{"throws", [](IceEstimate& e) { e.throws = -1; }},
                    BadIce{"no_variance", [](IceEstimate& e) { e.covariance[0] = 0.0; }},
                    BadIce{"asymmetric", [](IceEstimate& e) { e.covariance[1] = 1e-3; }},
                    BadIce{"indefinite", [](IceEstimate& e) { e.covariance[1] = e.covariance[3] = 0.1; }}),
    [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace hogline::servo::test
