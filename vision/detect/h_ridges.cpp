#include "vision/detect/h_ridges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr float most_light = 1.5F;     // a lamp's reflection counts no more than this
constexpr float least_light = 0.08F;   // sides darker than this are no ice
constexpr float weakest = 0.05F;       // a ridge weaker than this is noise
constexpr double measurable_px = 3.0;  // paint thinner than this in the picture has no width to measure
constexpr std::size_t index_of(int block, int rows, int row) {
  return static_cast<std::size_t>(block) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(row);
}

}  // namespace

HogRidgeFinder::HogRidgeFinder(const GroundView& view, double range_m)
    : view_(view),
      response_(view.setup().gamma),
      camera_(view.lens(), view.gMc(), view.setup().ice),
      top_(std::max(0, view.first_row(range_m) - 8)),
      rows_(view.setup().intrinsics.height_px - top_),
      blocks_(view.setup().intrinsics.width_px / block_px),
      thickness_px_(index_of(blocks_, rows_, 0), std::numeric_limits<float>::quiet_NaN()),
      light_(thickness_px_.size(), 0.0F),
      sum_(static_cast<std::size_t>(rows_) + 1, 0.0F) {
  const auto ahead = [&](double u, double v) {
    const auto n = view_.plane({u, v});
    const auto g = n ? view_.ground_of_plane(*n) : std::nullopt;
    return g ? g->y() : std::numeric_limits<double>::quiet_NaN();
  };
  for (int b = 0; b < blocks_; ++b) {
    for (int r = 0; r + 1 < rows_; ++r) {
      const double far_m = ahead(column_px(b), top_ + r);
      const double near_m = ahead(column_px(b), top_ + r + 1);
      if (far_m > near_m && far_m < range_m) {
        thickness_px_[index_of(b, rows_, r)] = static_cast<float>(rules::hog_line_width_m / (far_m - near_m));
      }
    }
  }
}

std::vector<HogRidge> HogRidgeFinder::find(const cv::Mat& image) {
  std::vector<HogRidge> found;
  if (rows_ < 32) return found;
  whiten(image);
  darkest(image);
  for (int b = 0; b < blocks_; ++b) search(b, found);
  return found;
}

// Ice is white and most of what lies below the horizon is ice: each colour's upper quartile there is its white.
void HogRidgeFinder::whiten(const cv::Mat& image) {
  const int channels = image.channels();
  std::array<std::array<int, 256>, 3> histogram{};
  int count = 0;
  for (int r = top_; r < image.rows; r += 8) {
    const std::uint8_t* row = image.ptr<std::uint8_t>(r);
    for (int c = 0; c < image.cols; c += 8, ++count) {
      for (int k = 0; k < channels; ++k) ++histogram[static_cast<std::size_t>(k)][row[c * channels + k]];
    }
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k) {
    int seen = 0;
    std::size_t value = 0;
    while (value < 255 && (seen += histogram[k][value]) * 4 < count * 3) ++value;
    const float white = std::max(response_.linear(static_cast<std::uint8_t>(value)), 1e-3F);
    for (std::size_t i = 0; i < 256; ++i) {
      white_[k][i] = std::min(response_.linear(static_cast<std::uint8_t>(i)) / white, most_light);
    }
  }
}

void HogRidgeFinder::darkest(const cv::Mat& image) {
  const int channels = image.channels();
  for (int r = 0; r < rows_; ++r) {
    const std::uint8_t* p = image.ptr<std::uint8_t>(top_ + r);
    for (int b = 0; b < blocks_; ++b) {
      float sum = 0.0F;
      for (int i = 0; i < block_px; ++i, p += channels) {
        float least = white_[0][p[0]];
        if (channels == 3) least = std::min(least, std::min(white_[1][p[1]], white_[2][p[2]]));
        sum += least;
      }
      light_[index_of(b, rows_, r)] = sum / block_px;
    }
  }
}

void HogRidgeFinder::search(int block, std::vector<HogRidge>& found) {
  const float* light = &light_[index_of(block, rows_, 0)];
  const float* thickness = &thickness_px_[index_of(block, rows_, 0)];
  for (int r = 0; r < rows_; ++r) sum_[static_cast<std::size_t>(r) + 1] = sum_[static_cast<std::size_t>(r)] + light[r];
  const auto mean = [&](int from, int to) {  // rows [from, to)
    return (sum_[static_cast<std::size_t>(to)] - sum_[static_cast<std::size_t>(from)]) / static_cast<float>(to - from);
  };

  HogRidge best;
  int best_row = -1;
  float best_sides = 0.0F;
  const auto keep = [&] {
    if (best_row < 0) return;
    best.pixel = {column_px(block), static_cast<double>(top_ + best_row)};
    const auto level = static_cast<double>(best_sides) * (1.0 - 0.5 * best.strength);
    best.width_m =
        static_cast<double>(thickness[best_row]) >= measurable_px ? measured_width(block, best_row, level) : 0.0;
    if (const auto ice = camera_.paint_at(best.pixel)) {
      best.ice = *ice;
      found.push_back(best);
    }
    best_row = -1;
  };

  for (int r = 0; r < rows_; ++r) {
    const float t = thickness[r];
    if (!(t > 0.0F) || t > static_cast<float>(rows_) / 4.0F) continue;
    const int half = static_cast<int>(t / 2.0F);
    const int gap = 1 + static_cast<int>(t / 8.0F);
    const int side = std::clamp(static_cast<int>(t), 3, 40);
    const int from = r - half;
    const int to = r + half + 1;
    if (from - gap - side < 0 || to + gap + side > rows_) continue;
    const float above = mean(from - gap - side, from - gap);
    const float below = mean(to + gap, to + gap + side);
    const float sides = std::min(above, below);
    const float inside = mean(from, to);
    const float strength = sides > least_light ? 1.0F - inside / sides : 0.0F;
    if (best_row >= 0 && r - best_row > std::max(2, half)) keep();
    if (strength < weakest || (best_row >= 0 && static_cast<double>(strength) <= best.strength)) continue;
    const float rows_taken = static_cast<float>(to - from + 2 * gap);
    const float taken = rows_taken * (1.0F - mean(from - gap, to + gap) / (0.5F * (above + below)));
    best.column = block;
    best.strength = static_cast<double>(strength);
    best.contrast = std::clamp(static_cast<double>(taken / std::max(t, 0.1F)), 0.0, 1.0);
    best_row = r;
    best_sides = sides;
  }
  keep();
}

// From where it crosses the level half way between paint and ice above the row to where it does below.
double HogRidgeFinder::measured_width(int block, int row, double level) const {
  const float* light = &light_[index_of(block, rows_, 0)];
  const auto crossing = [&](int step) {
    int r = row;
    while (r + step >= 0 && r + step < rows_ && static_cast<double>(light[r + step]) < level) r += step;
    if (r + step < 0 || r + step >= rows_) return static_cast<double>(r);
    const double rise = static_cast<double>(light[r + step] - light[r]);
    return r + step * (rise > 0.0 ? std::clamp((level - static_cast<double>(light[r])) / rise, 0.0, 1.0) : 0.0);
  };
  return (crossing(1) - crossing(-1)) / static_cast<double>(thickness_px_[index_of(block, rows_, row)]) *
         rules::hog_line_width_m;
}

}  // namespace hogline::vision
