// Bytes become the picture the format says, colours in their places.
#include "hw/aravis/pixel_format.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace hogline::hw {
namespace {

constexpr int width = 16;
constexpr int height = 12;
constexpr int red = 200;
constexpr int green = 120;
constexpr int blue = 40;

// A uniformly coloured sheet seen through a colour filter whose first two rows are `pattern`, e.g. "RGGB".
std::vector<std::uint8_t> mosaic(const std::string& pattern) {
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char filter = pattern[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
      bytes.push_back(static_cast<std::uint8_t>(filter == 'R' ? red : filter == 'G' ? green : blue));
    }
  }
  return bytes;
}

struct Case {
  const char* description;
  std::uint32_t format;
  std::vector<std::uint8_t> bytes;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.description; }

std::vector<std::uint8_t> repeated(std::initializer_list<int> pixel) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < width * height; ++i) {
    for (const int value : pixel) bytes.push_back(static_cast<std::uint8_t>(value));
  }
  return bytes;
}

class Colours : public testing::TestWithParam<Case> {};

// The numbers are those of the convention's table, not of our header.
TEST_P(Colours, come_out_as_blue_green_red) {
  const auto picture = pfnc::to_picture(GetParam().bytes, width, height, GetParam().format);
  ASSERT_TRUE(picture);
  ASSERT_EQ(picture->type(), CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto pixel = picture->at<cv::Vec3b>(y, x);
      ASSERT_EQ(pixel, cv::Vec3b(blue, green, red)) << x << " " << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, Colours,
                         testing::Values(Case{"BGR8", 0x02180015, repeated({blue, green, red})},
                                         Case{"RGB8", 0x02180014, repeated({red, green, blue})},
                                         Case{"BayerGR8", 0x01080008, mosaic("GRBG")},
                                         Case{"BayerRG8", 0x01080009, mosaic("RGGB")},
                                         Case{"BayerGB8", 0x0108000A, mosaic("GBRG")},
                                         Case{"BayerBG8", 0x0108000B, mosaic("BGGR")}));

TEST(PixelFormat, mono_stays_one_channel_and_is_a_copy) {
  std::vector<std::uint8_t> bytes = repeated({17});
  const auto picture = pfnc::to_picture(bytes, width, height, 0x01080001);
  ASSERT_TRUE(picture);
  bytes.assign(bytes.size(), 0);
  EXPECT_EQ(picture->type(), CV_8UC1);
  EXPECT_EQ(picture->at<std::uint8_t>(5, 5), 17);
}

TEST(PixelFormat, refuses_what_it_does_not_know_or_what_is_too_short) {
  const auto bytes = repeated({17});
  EXPECT_FALSE(pfnc::to_picture(bytes, width, height, 0x01100007)) << "Mono16";
  EXPECT_FALSE(pfnc::to_picture(bytes, width, height, 0x02180014)) << "three bytes a pixel";
  EXPECT_FALSE(pfnc::to_picture(bytes, width + 1, height, 0x01080001));
  EXPECT_FALSE(pfnc::to_picture(bytes, 0, height, 0x01080001));
  EXPECT_FALSE(pfnc::to_picture(bytes, -1, -192, 0x01080001));
  EXPECT_EQ(pfnc::name(0x01100007), "0x01100007");
  EXPECT_EQ(pfnc::name(0x01080009), "BayerRG8");
}

}  // namespace
}  // namespace hogline::hw
