#include "vision/geometry/response_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hogline::vision {
namespace {

TEST(ResponseCurve, IsThePowerOfTheGammaAtEveryPixelValue) {
  for (const double gamma : {1.0, 1.8, 2.2}) {
    const ResponseCurve curve(gamma);
    for (int i = 0; i < 256; ++i) {
      const auto expected = static_cast<float>(std::pow(i / 255.0, gamma));
      EXPECT_FLOAT_EQ(curve.linear(static_cast<std::uint8_t>(i)), expected);
      EXPECT_FLOAT_EQ(curve.linear(static_cast<float>(i)), expected);
    }
  }
}

TEST(ResponseCurve, GrowsBetweenPixelValuesAndIsClampedOutside) {
  const ResponseCurve curve(2.2);
  for (float v = 0.0F; v < 254.5F; v += 0.25F) EXPECT_LT(curve.linear(v), curve.linear(v + 0.25F));
  EXPECT_FLOAT_EQ(curve.linear(-3.0F), 0.0F);
  EXPECT_FLOAT_EQ(curve.linear(400.0F), 1.0F);
}

}  // namespace
}  // namespace hogline::vision
