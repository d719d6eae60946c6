#include "servo/yaw_bias.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

struct Turn {
  std::function<double(double)> bias_of_true;  ///< seen less true
  double gyro_bias_radps = 0.0;
  double look_sigma_rad = 0.0;
  double first_rad = -8.0 * degree;
  double last_rad = 8.0 * degree;
  bool back = true;
};

// There and back at 2 deg/s, 20 looks a second.
std::vector<TurnSample> turn(const Turn& t) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<TurnSample> samples;
  const double rate = 2.0 * degree;
  const double one_way_s = (t.last_rad - t.first_rad) / rate;
  for (double time = 0.0; time < (t.back ? 2.0 : 1.0) * one_way_s; time += 0.05) {
    const double yaw = time < one_way_s ? t.first_rad + rate * time : t.last_rad - rate * (time - one_way_s);
    const double seen = yaw + t.bias_of_true(yaw) + t.look_sigma_rad * normal(random);
    samples.push_back({time, seen, 0.7 + yaw - t.first_rad + t.gyro_bias_radps * time});
  }
  return samples;
}

TEST(YawBias, IsFoundByTurningThereAndBackAndTakenOff) {
  // The paper's figure 8(a): a difference that grows with the estimate around a bias.
  const auto bias = [](double yaw) { return 0.3 * degree + 0.04 * yaw + 0.8 * yaw * yaw; };
  for (const double gyro_bias : {0.0, 20.0 * degree / 3600.0, -0.01 * degree}) {
    const Turn there{.bias_of_true = bias, .gyro_bias_radps = gyro_bias, .look_sigma_rad = 0.005 * degree};
    const double reference = bias(0.0);
    const YawBiasCalibration c = calibrate_yaw_bias(turn(there), 17, reference, reference);
    ASSERT_TRUE(c.ok) << c.reason;
    EXPECT_NEAR(c.gyro_bias_radps, gyro_bias, 0.001 * degree);
    EXPECT_LT(c.residual_rad, 0.007 * degree);
    for (double yaw = -7.9 * degree; yaw < 7.9 * degree; yaw += 0.1 * degree) {
      SheetPosePercept percept;
      percept.ok = true;
      percept.body.yaw_rad = yaw + bias(yaw);
      EXPECT_NEAR(without_yaw_bias(percept, c.table).body.yaw_rad, yaw, 0.006 * degree) << yaw / degree;
    }
  }
}

TEST(YawBias, ViewsWithoutOneGetNone) {
  const Turn there{.bias_of_true = [](double) { return 0.0; }, .look_sigma_rad = 0.005 * degree};
  const YawBiasCalibration c = calibrate_yaw_bias(turn(there), 9, 0.0, 0.0);
  ASSERT_TRUE(c.ok) << c.reason;
  EXPECT_LT(c.largest_rad, 0.006 * degree);
}

TEST(YawBias, TheRunAlongTheCentreLineTiesItDown) {
  // 5 cm to the left after 10 m: the body pointed to the left of where it was seen to point.
  EXPECT_NEAR(reference_bias_rad(0.05, 10.0), -0.2865 * degree, 1e-3 * degree);
  const Turn there{.bias_of_true = [](double) { return -0.2865 * degree; }};
  const YawBiasCalibration c = calibrate_yaw_bias(turn(there), 5, 0.0, reference_bias_rad(0.05, 10.0));
  ASSERT_TRUE(c.ok);
  for (const YawBiasKnot& knot : c.table) EXPECT_NEAR(knot.bias_rad, -0.2865 * degree, 1e-3 * degree);
}

TEST(YawBias, WhatCanNotBeToldIsRefused) {
  const auto none = [](double) { return 0.0; };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(calibrate_yaw_bias({}, 9, 0.0, 0.0).ok);
  EXPECT_FALSE(calibrate_yaw_bias(turn({.bias_of_true = none}), 1, 0.0, 0.0).ok);
  EXPECT_FALSE(calibrate_yaw_bias(turn({.bias_of_true = none, .first_rad = 0.0, .last_rad = 0.01}), 3, 0.0, 0.0).ok);
  EXPECT_FALSE(calibrate_yaw_bias(turn({.bias_of_true = none}), 9, 0.0, nan).ok);
  const YawBiasCalibration one_way = calibrate_yaw_bias(turn({.bias_of_true = none, .back = false}), 9, 0.0, 0.0);
  EXPECT_FALSE(one_way.ok) << "slope of the table and bias of the gyro can not be told apart";
  EXPECT_FALSE(one_way.reason.empty());
  auto spoilt = turn({.bias_of_true = none});
  spoilt[7].gyro_rad = nan;
  EXPECT_FALSE(calibrate_yaw_bias(spoilt, 9, 0.0, 0.0).ok);
}

TEST(YawBias, TheTableIsFlatBeyondItsEndsAndEmptyMeansNone) {
  const YawBiasTable table{{-0.1, 0.01}, {0.0, 0.0}, {0.1, 0.03}};
  EXPECT_DOUBLE_EQ(yaw_bias(table, -1.0), 0.01);
  EXPECT_DOUBLE_EQ(yaw_bias(table, 1.0), 0.03);
  EXPECT_NEAR(yaw_bias(table, -0.05), 0.005, 1e-12);
  EXPECT_NEAR(yaw_bias(table, 0.05), 0.015, 1e-12);
  EXPECT_DOUBLE_EQ(yaw_bias({}, 0.05), 0.0);
}

}  // namespace
}  // namespace hogline::servo::test
