#include "vision/detect/white_light.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr int step_px = 4;
constexpr double percentile = 0.65;
constexpr int reach_blocks = 2;  // paint fills at most so many blocks in a row
constexpr float least_light = 0.004F;
constexpr double bright_share = 0.3;  // of the blocks: white ice is among them
constexpr float least_share = 0.05F;

/// Of blue, green and red.
std::array<std::uint8_t, 3> high_levels(const cv::Mat& bgr, const cv::Rect& block) {
  std::array<std::array<int, 256>, 3> histograms{};
  int count = 0;
  for (int y = block.y; y < block.br().y; y += step_px) {
    const std::uint8_t* in = bgr.ptr<std::uint8_t>(y) + 3 * block.x;
    for (int x = block.x; x < block.br().x; x += step_px, ++count, in += 3 * step_px) {
      for (std::size_t k = 0; k < 3; ++k) ++histograms[k][in[k]];
    }
  }
  std::array<std::uint8_t, 3> levels{};
  for (std::size_t k = 0; k < 3; ++k) {
    // From above: ice is light.
    int up_to = count;
    std::size_t level = 255;
    while (level > 0 && up_to - histograms[k][level] >= percentile * count) up_to -= histograms[k][level--];
    levels[k] = static_cast<std::uint8_t>(level);
  }
  return levels;
}

float sum_of(const std::array<float, 3>& light) { return light[0] + light[1] + light[2]; }

// What colour white ice is: the middle one of the brighter blocks, for there is more ice than paint and nothing is
// brighter. Shares of the brightest channel.
std::array<float, 3> white_of(const std::vector<std::array<float, 3>>& blocks) {
  std::vector<std::array<float, 3>> bright = blocks;
  const auto rank = static_cast<std::ptrdiff_t>(static_cast<double>(bright.size()) * (1.0 - bright_share));
  std::nth_element(bright.begin(), bright.begin() + rank, bright.end(),
                   [](const auto& a, const auto& b) { return sum_of(a) < sum_of(b); });
  bright.erase(bright.begin(), bright.begin() + rank);
  std::array<float, 3> white{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto middle = bright.begin() + static_cast<std::ptrdiff_t>(bright.size() / 2);
    const auto share = [k](const std::array<float, 3>& light) { return light[k] / sum_of(light); };
    std::nth_element(bright.begin(), middle, bright.end(),
                     [&](const auto& a, const auto& b) { return share(a) < share(b); });
    white[k] = share(*middle);
  }
  const float most = std::max({white[0], white[1], white[2]});
  for (float& part : white) part = std::max(least_share, part / most);
  return white;
}

// A block that paint fills: white would be as bright in every channel as the paint is in its brightest.
void whiten(const std::array<float, 3>& white, std::array<float, 3>& light) {
  const float level = std::max({light[0] / white[0], light[1] / white[1], light[2] / white[2]});
  for (std::size_t k = 0; k < 3; ++k) light[k] = level * white[k];
}

}  // namespace

WhiteLight::WhiteLight(const cv::Mat& bgr, const ResponseCurve& response, int top)
    : top_(std::clamp(top, 0, bgr.rows - 1)),
      columns_((bgr.cols + block_px - 1) / block_px),
      rows_((bgr.rows - top_ + block_px - 1) / block_px) {
  std::vector<std::array<float, 3>> own(static_cast<std::size_t>(columns_ * rows_));
  for (int r = 0; r < rows_; ++r) {
    for (int c = 0; c < columns_; ++c) {
      const cv::Rect block =
          cv::Rect(c * block_px, top_ + r * block_px, block_px, block_px) & cv::Rect(0, 0, bgr.cols, bgr.rows);
      const auto levels = high_levels(bgr, block);
      for (std::size_t k = 0; k < 3; ++k) {
        own[static_cast<std::size_t>(r * columns_ + c)][k] = std::max(least_light, response.linear(levels[k]));
      }
    }
  }
  const std::array<float, 3> white = white_of(own);
  for (auto& light : own) whiten(white, light);
  light_ = own;
  for (int r = 0; r < rows_; ++r) {
    for (int c = 0; c < columns_; ++c) {
      auto& best = light_[static_cast<std::size_t>(r * columns_ + c)];
      for (int y = std::max(0, r - reach_blocks); y <= std::min(rows_ - 1, r + reach_blocks); ++y) {
        for (int x = std::max(0, c - reach_blocks); x <= std::min(columns_ - 1, c + reach_blocks); ++x) {
          const auto& other = own[static_cast<std::size_t>(y * columns_ + x)];
          if (sum_of(other) > sum_of(best)) best = other;
        }
      }
    }
  }
}

WhiteLight WhiteLight::in_smaller(double scale) const {
  WhiteLight smaller = *this;
  smaller.scale_ = scale * scale_;
  return smaller;
}

std::array<float, 3> WhiteLight::at(double x, double y) const {
  const double u = std::clamp(scale_ * x / block_px - 0.5, 0.0, columns_ - 1.0);
  const double v = std::clamp((scale_ * y - top_) / block_px - 0.5, 0.0, rows_ - 1.0);
  const int c = std::min(static_cast<int>(u), std::max(0, columns_ - 2));
  const int r = std::min(static_cast<int>(v), std::max(0, rows_ - 2));
  const auto fu = static_cast<float>(u - c);
  const auto fv = static_cast<float>(v - r);
  const auto cell = [this](int row, int column) -> const std::array<float, 3>& {
    return light_[static_cast<std::size_t>(std::min(row, rows_ - 1) * columns_ + std::min(column, columns_ - 1))];
  };
  std::array<float, 3> light{};
  for (std::size_t k = 0; k < 3; ++k) {
    const float upper = cell(r, c)[k] + fu * (cell(r, c + 1)[k] - cell(r, c)[k]);
    const float lower = cell(r + 1, c)[k] + fu * (cell(r + 1, c + 1)[k] - cell(r + 1, c)[k]);
    light[k] = upper + fv * (lower - upper);
  }
  return light;
}

}  // namespace hogline::vision
