// Edges of any colour, where they are asked for: the gradient of the picture's light against white ice.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/white_light.hpp"

namespace hogline::vision {

/// Works on the light's square root, in which noise is the same everywhere, and tile by tile: only tiles that are asked
/// for are ever computed.
class EdgeField {
 public:
  /// The references are kept. Precondition: CV_8UC3, not empty.
  EdgeField(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response);

  /// How much of an edge with this unit normal stands at a pixel, 0..1; its sense and colour do not count.
  float edge(float x, float y, float normal_x, float normal_y);

 private:
  static constexpr int tile_px = 32;
  struct Gradient {
    std::array<std::int16_t, 3> x;
    std::array<std::int16_t, 3> y;
  };
  using Tile = std::array<Gradient, tile_px * tile_px>;

  void compute(int column, int row, Tile& tile) const;

  const cv::Mat& bgr_;
  const WhiteLight& ice_;
  int columns_;
  std::array<float, 256> root_{};
  std::vector<std::unique_ptr<Tile>> tiles_;
};

}  // namespace hogline::vision
