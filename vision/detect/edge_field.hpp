// Edges of any colour, where they are asked for: the gradient of the picture's light against white ice.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/white_light.hpp"

namespace hogline::vision {

/// One number for each of four places of a row of the picture.
using FourPlaces = Eigen::Array4f;

/// Works on the light's square root, in which noise is the same everywhere, and tile by tile: only tiles that are asked
/// for are ever computed. Keeps its memory from picture to picture.
class EdgeField {
 public:
  /// Takes up a picture. The references are kept until the next one. Precondition: CV_8UC3, not empty.
  void begin(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response);

  /// How much of an edge with this unit normal stands at a pixel and at the next three, `step` (1 or 2) pixels apart
  /// in its row: 0..1; its sense and colour do not count. Outside the picture there are none.
  [[gnu::always_inline]] FourPlaces edges(float x, float y, int step, float normal_x, float normal_y) {
    const int column = static_cast<int>(x + 0.5F);
    const int row = static_cast<int>(y + 0.5F);
    const int last = column + 3 * step;
    if (x < 0.0F || y < 0.0F || last >= width_ || row >= height_) return at_border(x, y, step, normal_x, normal_y);
    const std::uint8_t* known = &known_[static_cast<std::size_t>((row >> tile_bits) * columns_)];
    if (known[column >> tile_bits] == 0) compute(column >> tile_bits, row >> tile_bits);
    if (known[last >> tile_bits] == 0) compute(last >> tile_bits, row >> tile_bits);
    const float* gx = x_.ptr<float>() + row * pitch_ + column;
    const float* gy = y_.ptr<float>() + row * pitch_ + column;
    if (step == 1)
      return strength(Eigen::Map<const FourPlaces>(gx), Eigen::Map<const FourPlaces>(gy), normal_x, normal_y);
    return strength({gx[0], gx[2], gx[4], gx[6]}, {gy[0], gy[2], gy[4], gy[6]}, normal_x, normal_y);
  }

 private:
  static constexpr int tile_bits = 4;
  static constexpr int tile_px = 1 << tile_bits;
  static constexpr float noise_floor = 0.227F;  // of a full edge

  static FourPlaces strength(const FourPlaces& gx, const FourPlaces& gy, float normal_x, float normal_y) {
    const FourPlaces across = (gx * normal_x + gy * normal_y).abs();
    const FourPlaces along = (gy * normal_x - gx * normal_y).abs();
    return (across - 0.5F * along - noise_floor).max(0.0F).min(1.0F);
  }
  FourPlaces at_border(float x, float y, int step, float normal_x, float normal_y);
  void compute(int column, int row);

  const cv::Mat* bgr_ = nullptr;
  const WhiteLight* ice_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  int columns_ = 0;  ///< of tiles
  std::array<float, 256> root_{};
  std::vector<std::uint8_t> known_;  ///< tiles that are computed
  int pitch_ = 0;                    ///< of the gradient's rows
  cv::Mat x_, y_;  ///< CV_32F, gradient of all channels together, turned to one sense; 1 is a full edge
};

}  // namespace hogline::vision
