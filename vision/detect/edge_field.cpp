#include "vision/detect/edge_field.hpp"

#include <Eigen/Core>

namespace hogline::vision {
namespace {

constexpr float full_edge = 0.22F;  // gradient, all channels, of a step of about half the light of ice
constexpr float brightest = 1.5F;   // lamps' reflections are cut off

/// A tile and a pixel about it.
template <int tile_px>
struct Light {
  static constexpr int wide = tile_px + 2;
  std::array<float, wide * wide> root;

  const float* row(int y) const { return &root[static_cast<std::size_t>(y * wide)]; }

  void take(const cv::Mat& bgr, int x0, int y0, int channel, const std::array<float, 256>& roots, float against) {
    constexpr float scale = 0.125F / full_edge;
    const bool inside = x0 >= 1 && x0 + tile_px < bgr.cols;
    for (int y = 0; y < wide; ++y) {
      const std::uint8_t* in = bgr.ptr<std::uint8_t>(std::clamp(y0 + y - 1, 0, bgr.rows - 1)) + channel;
      float* out = &root[static_cast<std::size_t>(y * wide)];
      if (inside) {
        in += 3 * (x0 - 1);
        for (int x = 0; x < wide; ++x) out[x] = roots[in[3 * x]];
      } else {
        for (int x = 0; x < wide; ++x) out[x] = roots[in[3 * std::clamp(x0 + x - 1, 0, bgr.cols - 1)]];
      }
    }
    // Eigen's minimum has no branches.
    Eigen::Map<Eigen::Array<float, wide * wide, 1>> all(root.data());
    all = scale * (against * all).min(brightest);
  }
};

/// Binomial along the edge, differences across it; of one row.
template <int tile_px>
void gradient(const Light<tile_px>& light, int y, float* gx, float* gy) {
  const float* a = light.row(y);
  const float* b = light.row(y + 1);
  const float* c = light.row(y + 2);
  for (int x = 0; x < tile_px; ++x) {
    gx[x] = a[x + 2] + 2.0F * b[x + 2] + c[x + 2] - a[x] - 2.0F * b[x] - c[x];
    gy[x] = c[x] + 2.0F * c[x + 1] + c[x + 2] - a[x] - 2.0F * a[x + 1] - a[x + 2];
  }
}

}  // namespace

void EdgeField::begin(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response) {
  bgr_ = &bgr;
  ice_ = &ice;
  width_ = bgr.cols;
  height_ = bgr.rows;
  columns_ = (bgr.cols + tile_px - 1) / tile_px;
  tiles_.assign(static_cast<std::size_t>(columns_ * ((bgr.rows + tile_px - 1) / tile_px)), nullptr);
  used_ = 0;
  for (std::size_t i = 0; i < 256; ++i) root_[i] = std::sqrt(response.linear(static_cast<std::uint8_t>(i)));
}

const EdgeField::Tile* EdgeField::compute(int column, int row) {
  if (used_ == memory_.size()) memory_.emplace_back();
  Tile& tile = memory_[used_++];
  const int x0 = column * tile_px;
  const int y0 = row * tile_px;
  const auto white = ice_->at(x0 + 0.5 * tile_px, y0 + 0.5 * tile_px);
  for (int k = 0; k < 3; ++k) {
    const float against = 1.0F / std::sqrt(white[static_cast<std::size_t>(k)]);
    Light<tile_px> light;
    light.take(*bgr_, x0, y0, k, root_, against);
    for (int y = 0; y < tile_px; ++y) {
      std::array<float, tile_px> gx;
      std::array<float, tile_px> gy;
      gradient(light, y, gx.data(), gy.data());
      float* all_x = &tile.x[static_cast<std::size_t>(y * tile_px)];
      float* all_y = &tile.y[static_cast<std::size_t>(y * tile_px)];
      for (std::size_t x = 0; x < tile_px; ++x) {
        // Red paint on ice is an edge in blue and green, a red handle on granite one in red: the senses may differ.
        const float sense = k > 0 && all_x[x] * gx[x] + all_y[x] * gy[x] < 0.0F ? -1.0F : 1.0F;
        all_x[x] = (k > 0 ? all_x[x] : 0.0F) + sense * gx[x];
        all_y[x] = (k > 0 ? all_y[x] : 0.0F) + sense * gy[x];
      }
    }
  }
  tiles_[static_cast<std::size_t>(row * columns_ + column)] = &tile;
  return &tile;
}

}  // namespace hogline::vision
