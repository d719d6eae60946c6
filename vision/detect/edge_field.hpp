// Edges of any colour, where they are asked for: the gradient of the picture's light against white ice.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "vision/detect/white_light.hpp"

namespace hogline::vision {

/// Works on the light's square root, in which noise is the same everywhere, and tile by tile: only tiles that are asked
/// for are ever computed. Keeps its memory from picture to picture.
class EdgeField {
 public:
  /// Takes up a picture. The references are kept until the next one. Precondition: CV_8UC3, not empty.
  void begin(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response);

  /// How much of an edge with this unit normal stands at a pixel, 0..1; its sense and colour do not count.
  float edge(float x, float y, float normal_x, float normal_y) {
    const int column = static_cast<int>(x + 0.5F);
    const int row = static_cast<int>(y + 0.5F);
    if (x < 0.0F || y < 0.0F || column >= width_ || row >= height_) return 0.0F;
    const Tile* tile = tiles_[static_cast<std::size_t>(row / tile_px * columns_ + column / tile_px)];
    if (tile == nullptr) tile = compute(column / tile_px, row / tile_px);
    const auto at = static_cast<std::size_t>(row % tile_px * tile_px + column % tile_px);
    const float across = std::abs(tile->x[at] * normal_x + tile->y[at] * normal_y);
    const float along = std::abs(tile->y[at] * normal_x - tile->x[at] * normal_y);
    const float edge = across - 0.5F * along - noise_floor;
    const float positive = edge > 0.0F ? edge : 0.0F;
    return positive < 1.0F ? positive : 1.0F;
  }

 private:
  static constexpr int tile_px = 16;
  static constexpr float noise_floor = 0.227F;  // of a full edge
  /// Of all channels together, turned to one sense; 1 is a full edge.
  struct Tile {
    std::array<float, tile_px * tile_px> x;
    std::array<float, tile_px * tile_px> y;
  };

  const Tile* compute(int column, int row);

  const cv::Mat* bgr_ = nullptr;
  const WhiteLight* ice_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  int columns_ = 0;
  std::array<float, 256> root_{};
  std::vector<const Tile*> tiles_;
  std::deque<Tile> memory_;
  std::size_t used_ = 0;
};

}  // namespace hogline::vision
