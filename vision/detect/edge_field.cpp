#include "vision/detect/edge_field.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr float scale = 4096.0F;    // of the stored gradients
constexpr float full_edge = 0.22F;  // gradient, all channels, of a step of about half the light of ice
constexpr float noise_floor = 0.05F;
constexpr float brightest = 1.5F;  // lamps' reflections are cut off

}  // namespace

EdgeField::EdgeField(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response)
    : bgr_(bgr), ice_(ice), columns_((bgr.cols + tile_px - 1) / tile_px) {
  tiles_.resize(static_cast<std::size_t>(columns_ * ((bgr.rows + tile_px - 1) / tile_px)));
  for (std::size_t i = 0; i < 256; ++i) root_[i] = std::sqrt(response.linear(static_cast<std::uint8_t>(i)));
}

float EdgeField::edge(float x, float y, float normal_x, float normal_y) {
  const int column = static_cast<int>(x + 0.5F);
  const int row = static_cast<int>(y + 0.5F);
  if (x < 0.0F || y < 0.0F || column >= bgr_.cols || row >= bgr_.rows) return 0.0F;
  auto& tile = tiles_[static_cast<std::size_t>(row / tile_px * columns_ + column / tile_px)];
  if (!tile) {
    tile = std::make_unique<Tile>();
    compute(column / tile_px, row / tile_px, *tile);
  }
  const Gradient& g = (*tile)[static_cast<std::size_t>(row % tile_px * tile_px + column % tile_px)];
  float across = 0.0F;
  float along = 0.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    across += std::abs(g.x[k] * normal_x + g.y[k] * normal_y);
    along += std::abs(g.y[k] * normal_x - g.x[k] * normal_y);
  }
  return std::clamp(((across - 0.5F * along) / scale - noise_floor) / full_edge, 0.0F, 1.0F);
}

// Binomial along the edge, differences across it.
void EdgeField::compute(int column, int row, Tile& tile) const {
  const int x0 = column * tile_px;
  const int y0 = row * tile_px;
  const auto white = ice_.at(x0 + 0.5 * tile_px, y0 + 0.5 * tile_px);
  constexpr int wide = tile_px + 2;
  std::array<std::array<float, wide * wide>, 3> light;
  for (std::size_t k = 0; k < 3; ++k) {
    const float against = 1.0F / std::sqrt(white[k]);
    for (int y = 0; y < wide; ++y) {
      const std::uint8_t* in = bgr_.ptr<std::uint8_t>(std::clamp(y0 + y - 1, 0, bgr_.rows - 1));
      for (int x = 0; x < wide; ++x) {
        const int at = 3 * std::clamp(x0 + x - 1, 0, bgr_.cols - 1) + static_cast<int>(k);
        light[k][static_cast<std::size_t>(y * wide + x)] = std::min(brightest, root_[in[at]] * against);
      }
    }
    for (int y = 0; y < tile_px; ++y) {
      const float* a = &light[k][static_cast<std::size_t>(y * wide)];
      const float* b = a + wide;
      const float* c = b + wide;
      Gradient* out = &tile[static_cast<std::size_t>(y * tile_px)];
      for (int x = 0; x < tile_px; ++x) {
        const float gx = a[x + 2] + 2.0F * b[x + 2] + c[x + 2] - a[x] - 2.0F * b[x] - c[x];
        const float gy = c[x] + 2.0F * c[x + 1] + c[x + 2] - a[x] - 2.0F * a[x + 1] - a[x + 2];
        out[x].x[k] = static_cast<std::int16_t>(0.125F * scale * gx);
        out[x].y[k] = static_cast<std::int16_t>(0.125F * scale * gy);
      }
    }
  }
}

}  // namespace hogline::vision
