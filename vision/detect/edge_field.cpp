#include "vision/detect/edge_field.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr float full_edge = 0.22F;  // gradient, all channels, of a step of about half the light of ice
constexpr float brightest = 1.5F;   // lamps' reflections are cut off

/// A tile and a pixel about it: the roots of its light, channel by channel.
template <int tile_px>
struct Light {
  static constexpr int wide = tile_px + 2;
  std::array<std::array<float, wide * wide>, 3> root;

  const float* row(std::size_t channel, int y) const { return &root[channel][static_cast<std::size_t>(y * wide)]; }

  void take(const cv::Mat& bgr, int x0, int y0, const std::array<float, 256>& roots) {
    const bool inside = x0 >= 1 && x0 + tile_px < bgr.cols;
    std::size_t at = 0;
    for (int y = y0 - 1; y <= y0 + tile_px; ++y) {
      const std::uint8_t* row = bgr.ptr<std::uint8_t>(std::clamp(y, 0, bgr.rows - 1));
      for (int x = x0 - 1; x <= x0 + tile_px; ++x, ++at) {
        const std::uint8_t* in = row + 3 * (inside ? x : std::clamp(x, 0, bgr.cols - 1));
        for (std::size_t k = 0; k < 3; ++k) root[k][at] = roots[in[k]];
      }
    }
  }

  void scale(std::size_t channel, float white) {
    constexpr float unit = 0.125F / full_edge;
    const float against = 1.0F / std::sqrt(white);
    // Eigen's minimum has no branches.
    Eigen::Map<Eigen::Array<float, wide * wide, 1>> all(root[channel].data());
    all = unit * (against * all).min(brightest);
  }
};

template <int count>
using Numbers = Eigen::Array<float, count, 1>;

/// The gradient in one row of a tile.
template <int tile_px>
struct Row {
  Numbers<tile_px> x, y;

  /// Red paint on ice is an edge in blue and green, a red handle on granite one in red: the senses may differ.
  void add_in_one_sense(const Row& other) {
    Numbers<tile_px> sense = x * other.x + y * other.y;
    for (float& s : sense) s = std::copysign(1.0F, s);
    x += sense * other.x;
    y += sense * other.y;
  }
};

/// Of one channel. Differences across the edge, binomial along it: first within rows, each once, then between them.
template <int tile_px>
class Gradient {
 public:
  Gradient(const Light<tile_px>& light, std::size_t channel) {
    for (int y = 0; y < tile_px + 2; ++y) {
      const auto at = [&](int x) { return Eigen::Map<const Numbers<tile_px>>(light.row(channel, y) + x); };
      within_[static_cast<std::size_t>(y)] = {at(2) - at(0), at(0) + 2.0F * at(1) + at(2)};
    }
  }
  Row<tile_px> row(int y) const {
    const Row<tile_px>* at = &within_[static_cast<std::size_t>(y)];
    return {at[0].x + 2.0F * at[1].x + at[2].x, at[2].y - at[0].y};
  }

 private:
  std::array<Row<tile_px>, tile_px + 2> within_;
};

}  // namespace

void EdgeField::begin(const cv::Mat& bgr, const WhiteLight& ice, const ResponseCurve& response) {
  bgr_ = &bgr;
  ice_ = &ice;
  width_ = bgr.cols;
  height_ = bgr.rows;
  columns_ = (bgr.cols + tile_px - 1) / tile_px;
  const int rows = (bgr.rows + tile_px - 1) / tile_px;
  known_.assign(static_cast<std::size_t>(columns_ * rows), 0);
  pitch_ = columns_ * tile_px;
  x_.create(rows * tile_px, pitch_, CV_32F);
  y_.create(rows * tile_px, pitch_, CV_32F);
  for (std::size_t i = 0; i < 256; ++i) root_[i] = std::sqrt(response.linear(static_cast<std::uint8_t>(i)));
}

FourPlaces EdgeField::at_border(float x, float y, int step, float normal_x, float normal_y) {
  FourPlaces gx = FourPlaces::Zero();
  FourPlaces gy = FourPlaces::Zero();
  const int row = static_cast<int>(y + 0.5F);
  for (int i = 0; i < 4; ++i, x += static_cast<float>(step)) {
    const int column = static_cast<int>(x + 0.5F);
    if (x < 0.0F || y < 0.0F || column >= width_ || row >= height_) continue;
    if (known_[static_cast<std::size_t>(row / tile_px * columns_ + column / tile_px)] == 0) {
      compute(column / tile_px, row / tile_px);
    }
    gx[i] = x_.at<float>(row, column);
    gy[i] = y_.at<float>(row, column);
  }
  return strength(gx, gy, normal_x, normal_y);
}

void EdgeField::compute(int column, int row) {
  const int x0 = column * tile_px;
  const int y0 = row * tile_px;
  const auto white = ice_->at(x0 + 0.5 * tile_px, y0 + 0.5 * tile_px);
  Light<tile_px> light;
  light.take(*bgr_, x0, y0, root_);
  for (std::size_t k = 0; k < 3; ++k) light.scale(k, white[k]);
  const std::array<Gradient<tile_px>, 3> gradients{{{light, 0}, {light, 1}, {light, 2}}};
  for (int y = 0; y < tile_px; ++y) {
    Row<tile_px> all = gradients[0].row(y);
    all.add_in_one_sense(gradients[1].row(y));
    all.add_in_one_sense(gradients[2].row(y));
    Eigen::Map<Numbers<tile_px>>(x_.ptr<float>(y0 + y) + x0) = all.x;
    Eigen::Map<Numbers<tile_px>>(y_.ptr<float>(y0 + y) + x0) = all.y;
  }
  known_[static_cast<std::size_t>(row * columns_ + column)] = 1;
}

}  // namespace hogline::vision
