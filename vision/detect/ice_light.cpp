#include "vision/detect/ice_light.hpp"

#include <algorithm>
#include <cassert>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>

namespace hogline::vision {
namespace {

constexpr int unit_shift = 6;   // gains are multiples of 1/64
constexpr int most_gain = 256;  // of a pixel's 255 by it, 16 bits hold
using Gains = std::array<std::uint16_t, 3>;

Gains gains_to_white(const cv::Mat& image, int top) {
  std::array<std::array<int, 256>, 3> histogram{};
  int count = 0;
  for (int r = top; r < image.rows; r += 8) {
    const std::uint8_t* row = image.ptr<std::uint8_t>(r);
    for (int c = 0; c < image.cols; c += 8, ++count) {
      for (std::size_t k = 0; k < 3; ++k) ++histogram[k][row[3 * c + static_cast<int>(k)]];
    }
  }
  Gains gains{};
  for (std::size_t k = 0; k < 3; ++k) {
    int seen = 0;
    int value = 0;
    while (value < 255 && (seen += histogram[k][static_cast<std::size_t>(value)]) * 4 < count * 3) ++value;
    gains[k] = static_cast<std::uint16_t>(std::min((IceLight::white << unit_shift) / std::max(value, 1), most_gain));
  }
  return gains;
}

std::uint8_t scaled(std::uint8_t value, std::uint16_t gain) {
  return static_cast<std::uint8_t>(std::min((value * gain) >> unit_shift, 255));
}

cv::v_uint8x16 scaled(const cv::v_uint8x16& value, const cv::v_uint16x8& gain) {
  cv::v_uint16x8 low;
  cv::v_uint16x8 high;
  cv::v_expand(value, low, high);
  return cv::v_pack(cv::v_mul_wrap(low, gain) >> unit_shift, cv::v_mul_wrap(high, gain) >> unit_shift);
}

void darkest_row(const std::uint8_t* in, std::uint8_t* out, int columns, const Gains& gains) {
  constexpr int lanes = 16;
  const cv::v_uint16x8 blue_gain = cv::v_setall_u16(gains[0]);
  const cv::v_uint16x8 green_gain = cv::v_setall_u16(gains[1]);
  const cv::v_uint16x8 red_gain = cv::v_setall_u16(gains[2]);
  int c = 0;
  for (; c + lanes <= columns; c += lanes) {
    cv::v_uint8x16 blue;
    cv::v_uint8x16 green;
    cv::v_uint8x16 red;
    cv::v_load_deinterleave(in + 3 * c, blue, green, red);
    const cv::v_uint8x16 darker = cv::v_min(scaled(green, green_gain), scaled(red, red_gain));
    cv::v_store(out + c, cv::v_min(scaled(blue, blue_gain), darker));
  }
  for (; c < columns; ++c) {
    const std::uint8_t* p = in + 3 * c;
    out[c] = std::min({scaled(p[0], gains[0]), scaled(p[1], gains[1]), scaled(p[2], gains[2])});
  }
}

}  // namespace

void IceLight::read(const cv::Mat& image) {
  assert(image.type() == CV_8UC3 && image.rows - top_ >= 2);
  const Gains gains = gains_to_white(image, top_);
  darkest_.create(image.rows - top_, image.cols, CV_8UC1);
  for (int r = 0; r < darkest_.rows; ++r) {
    darkest_row(image.ptr<std::uint8_t>(top_ + r), darkest_.ptr<std::uint8_t>(r), image.cols, gains);
  }
  cv::resize(darkest_, half_, cv::Size(darkest_.cols / 2, darkest_.rows / 2), 0.0, 0.0, cv::INTER_AREA);
}

}  // namespace hogline::vision
