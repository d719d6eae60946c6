#include "vision/fit/product_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vision/fit/normal_table.hpp"

namespace hogline::vision {
namespace {

// What lies beyond the last pixel must not count, whatever it is: an earlier stone had more pixels.
TEST(ProductSums, AreThoseOfThePixelsAlone) {
  ProductSums products;
  products.begin(most_pixels);
  for (int i = 0; i < ProductSums::most_columns; ++i) {
    products.column(i).setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  for (const int pixels : {1, 2, 3, 4, 5, 150, most_pixels}) {
    for (const int columns : {4, 6, ProductSums::most_columns}) {
      products.begin(pixels);
      Pixels weights(pixels);
      for (int p = 0; p < pixels; ++p) weights[p] = 0.5F + static_cast<float>(p % 3);
      const auto number = [](int i, int p) { return std::sin(0.7 * i + 0.31 * p); };
      for (int i = 0; i < columns; ++i) {
        for (int p = 0; p < pixels; ++p) products.column(i)[p] = static_cast<float>(number(i, p));
      }
      ProductSums::Sums sums;
      products.sum_up(weights, columns, sums);
      for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < columns; ++j) {
          double expected = 0.0;
          for (int p = 0; p < pixels; ++p) expected += double{weights[p]} * number(i, p) * number(j, p);
          EXPECT_NEAR(sums(i, j), expected, 1e-4 + 1e-6 * pixels) << pixels << " pixels: " << i << ", " << j;
        }
      }
    }
  }
}

// Two parts of the light often share their first columns.
TEST(ProductSums, OfColumnsThatAreKnownAreNotTakenAgain) {
  const auto fill = [](ProductSums& products, double last) {
    products.begin(150);
    for (int i = 0; i < 6; ++i) {
      for (int p = 0; p < 150; ++p) products.column(i)[p] = static_cast<float>(std::sin((i < 3 ? 0.7 : last) * i + p));
    }
  };
  const Pixels weights = Pixels::Constant(150, 0.5F);
  ProductSums products, afresh;
  ProductSums::Sums sums, expected;
  fill(products, 1.0);
  products.sum_up(weights, 6, sums);
  fill(products, 2.0);
  products.sum_up(weights, 6, sums, 3);
  fill(afresh, 2.0);
  afresh.sum_up(weights, 6, expected);
  EXPECT_EQ((sums.topLeftCorner<6, 6>()), (expected.topLeftCorner<6, 6>()));
}

TEST(NormalTable, IsTheNormalDistributionAndPassesOnWhatIsNoNumber) {
  const NormalTable table;
  for (double z = -6.0; z < 6.0; z += 0.0131) {
    Eigen::Array4f integral;
    Eigen::Array4f density;
    const auto at = static_cast<float>(z);
    table.at({at, std::numeric_limits<float>::quiet_NaN(), -at, std::numeric_limits<float>::infinity()}, integral,
             density);
    const double expected = 0.5 * std::erfc(-z / std::sqrt(2.0));
    EXPECT_NEAR(integral[0], expected, 4e-5) << z;
    EXPECT_NEAR(integral[2], 1.0 - expected, 4e-5) << z;
    EXPECT_NEAR(density[0], std::exp(-0.5 * z * z) / std::sqrt(8.0 * std::atan(1.0)), 2e-4) << z;
    EXPECT_NEAR(integral[3], 1.0, 4e-5);
  }
}

}  // namespace
}  // namespace hogline::vision
