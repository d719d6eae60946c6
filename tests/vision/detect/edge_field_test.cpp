#include "vision/detect/edge_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hogline::vision {
namespace {

constexpr int width = 150;  // no whole number of tiles
constexpr int height = 90;
constexpr int edge_x = 70;

/// Ice, and from one column on something half as light.
cv::Mat step() {
  cv::Mat picture(height, width, CV_8UC3, cv::Scalar::all(200));
  picture.colRange(edge_x, width).setTo(cv::Scalar::all(60));
  return picture;
}

class EdgeFieldTest : public ::testing::Test {
 protected:
  EdgeFieldTest() { field.begin(picture, ice, response); }
  cv::Mat picture = step();
  ResponseCurve response{1.0};
  WhiteLight ice{picture, response, 0};
  EdgeField field;
};

TEST_F(EdgeFieldTest, StandsWhereTheLightChangesAndAcrossItAlone) {
  for (int x = 4; x + 4 < width; x += 4) {
    const FourPlaces across = field.edges(static_cast<float>(x), 40.0F, 1, 1.0F, 0.0F);
    const FourPlaces along = field.edges(static_cast<float>(x), 40.0F, 1, 0.0F, 1.0F);
    for (int i = 0; i < 4; ++i) {
      const bool on_edge = x + i == edge_x || x + i == edge_x - 1;
      EXPECT_FLOAT_EQ(across[i], on_edge ? 1.0F : 0.0F) << x + i;
      EXPECT_FLOAT_EQ(along[i], 0.0F) << x + i;
    }
  }
}

TEST_F(EdgeFieldTest, PlacesTwoPixelsApartAreTheSame) {
  for (int x = 0; x + 8 < width; ++x) {
    const FourPlaces wide = field.edges(static_cast<float>(x), 33.3F, 2, 0.8F, 0.6F);
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(wide[i], field.edges(static_cast<float>(x + 2 * i), 33.3F, 1, 0.8F, 0.6F)[0]) << x << " " << i;
    }
  }
}

TEST_F(EdgeFieldTest, OutsideThePictureThereAreNone) {
  for (const float y : {-20.0F, -1.0F, 89.6F, 300.0F}) {
    EXPECT_EQ(field.edges(edge_x - 2.0F, y, 1, 1.0F, 0.0F).maxCoeff(), 0.0F) << y;
  }
  // Half in, half out: the picture ends at the edge that is looked for.
  const cv::Mat cut = picture.colRange(0, edge_x + 1).clone();
  const WhiteLight light(cut, response, 0);
  field.begin(cut, light, response);
  const FourPlaces last = field.edges(edge_x - 1.0F, 40.0F, 1, 1.0F, 0.0F);
  EXPECT_FLOAT_EQ(last[0], 1.0F);
  EXPECT_GT(last[1], 0.0F);
  EXPECT_EQ(last[2], 0.0F);
  EXPECT_EQ(last[3], 0.0F);
}

}  // namespace
}  // namespace hogline::vision
