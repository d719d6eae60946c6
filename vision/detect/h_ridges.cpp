#include "vision/detect/h_ridges.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

constexpr float most_light = 1.5F;     // a lamp's reflection counts no more than this
constexpr float least_light = 0.08F;   // sides darker than this are no ice
constexpr float weakest = 0.05F;       // a ridge weaker than this is noise
constexpr int least_side_rows = 3;     // of ice beside the paint
constexpr double nearest_m = 0.15;     // ahead of the camera: below it nothing lies across
constexpr double measurable_px = 3.0;  // paint thinner than this in the picture has no width to measure
constexpr std::size_t index_of(int block, int rows, int row) {
  return static_cast<std::size_t>(block) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(row);
}

// Wide paint is found in every few rows; its edges then tell its middle.
int row_step(float thickness_px) { return thickness_px > 12.0F ? static_cast<int>(thickness_px / 6.0F) : 1; }

}  // namespace

HogRidgeFinder::HogRidgeFinder(const GroundView& view, double range_m)
    : view_(view),
      camera_(view.lens(), view.gMc(), view.setup().ice),
      top_(std::clamp(view.first_row(range_m) - 8, 0, view.setup().intrinsics.height_px - 2) & ~1),
      rows_(view.setup().intrinsics.height_px - top_),
      blocks_(view.setup().intrinsics.width_px / block_px),
      thickness_px_(index_of(blocks_, rows_, 0), std::numeric_limits<float>::quiet_NaN()),
      light_(thickness_px_.size(), 0.0F),
      sum_(index_of(blocks_, rows_ + 1, 0), 0.0F) {
  for (int i = 0; i <= 255 * block_px; ++i) {
    const double level = static_cast<double>(i) / (block_px * IceLight::white);
    linear_.push_back(std::min(static_cast<float>(std::pow(level, view.setup().gamma)), most_light));
  }
  const auto ahead = [&](double u, double v) {
    const auto n = view_.plane({u, v});
    const auto g = n ? view_.ground_of_plane(*n) : std::nullopt;
    return g ? g->y() : std::numeric_limits<double>::quiet_NaN();
  };
  for (int b = 0; b < blocks_; ++b) {
    for (int r = 0; r + 1 < rows_; ++r) {
      const double far_m = ahead(column_px(b), top_ + r);
      const double near_m = ahead(column_px(b), top_ + r + 1);
      if (far_m > near_m && near_m > camera_.eMc().translation().y() + nearest_m && far_m < range_m) {
        thickness_px_[index_of(b, rows_, r)] = static_cast<float>(rules::hog_line_width_m / (far_m - near_m));
      }
    }
  }
}

std::vector<HogRidge> HogRidgeFinder::find(const IceLight& light) {
  assert(light.top() == top_ && light.darkest().rows == rows_);
  std::vector<HogRidge> found;
  if (rows_ < 32) return found;
  gather(light);
  for (int b = 0; b < blocks_; ++b) search(b, found);
  return found;
}

// Turned from rows to columns some rows at a time, which the processor's cache holds.
void HogRidgeFinder::gather(const IceLight& light) {
  constexpr int together = 16;
  for (int begin = 0; begin < rows_; begin += together) {
    const int end = std::min(begin + together, rows_);
    for (int b = 0; b < blocks_; ++b) {
      float* out = &light_[index_of(b, rows_, 0)];
      for (int r = begin; r < end; ++r) {
        const std::uint8_t* p = light.darkest().ptr<std::uint8_t>(r) + b * block_px;
        out[r] = linear_[static_cast<std::size_t>(p[0] + p[1] + p[2] + p[3])];
      }
    }
  }
  static_assert(block_px == 4);
  for (int b = 0; b < blocks_; ++b) {
    const float* column = &light_[index_of(b, rows_, 0)];
    float* sum = &sum_[index_of(b, rows_ + 1, 0)];
    for (int r = 0; r < rows_; ++r) sum[r + 1] = sum[r] + column[r];
  }
}

std::optional<HogRidgeFinder::Profile> HogRidgeFinder::profile(int block, int row) const {
  const float t = thickness_px_[index_of(block, rows_, row)];
  if (!(t > 0.0F) || t > static_cast<float>(rows_) / 4.0F) return std::nullopt;
  const int half = static_cast<int>(t / 2.0F);
  const int gap = 1 + static_cast<int>(t / 8.0F);
  const int side = std::clamp(static_cast<int>(t), 3, 40);
  const int from = row - half;
  const int to = row + half + 1;
  const int below_end = std::min(to + gap + side, rows_);
  if (from - gap - side < 0 || below_end - to - gap < least_side_rows) return std::nullopt;
  const float* sum = &sum_[index_of(block, rows_ + 1, 0)];
  const auto mean = [sum](int begin, int end) { return (sum[end] - sum[begin]) / static_cast<float>(end - begin); };
  Profile p{mean(from, to), mean(from - gap - side, from - gap), mean(to + gap, below_end), 0.0F};
  if (std::min(p.above, p.below) < least_light) return std::nullopt;
  p.taken =
      static_cast<float>(to - from + 2 * gap) * (1.0F - mean(from - gap, to + gap) / (0.5F * (p.above + p.below)));
  return p;
}

std::optional<double> HogRidgeFinder::contrast_at(int block, double row_px) const {
  const int row = static_cast<int>(std::lround(row_px)) - top_;
  if (block < 0 || block >= blocks_ || row < 0 || row >= rows_) return std::nullopt;
  const auto p = profile(block, row);
  if (!p) return std::nullopt;
  const float share = p->taken / std::max(thickness_px_[index_of(block, rows_, row)], 0.1F);
  // What is darker on one side only is an edge, no line.
  return static_cast<double>(std::clamp(p->strength() > 0.0F ? share : std::min(share, 0.0F), -1.0F, 1.0F));
}

void HogRidgeFinder::search(int block, std::vector<HogRidge>& found) const {
  const float* thickness = &thickness_px_[index_of(block, rows_, 0)];
  HogRidge best;
  int best_row = -1;
  float best_level = 0.0F;
  const auto keep = [&] {
    if (best_row < 0) return;
    const double t = static_cast<double>(thickness[best_row]);
    double row = best_row;
    best.width_m = 0.0;
    if (t >= measurable_px) {
      const Edges e = edges(block, best_row, static_cast<double>(best_level));
      best.width_m = (e.near_px - e.far_px) / t * rules::hog_line_width_m;
      if (std::abs(best.width_m - rules::hog_line_width_m) < 0.3 * rules::hog_line_width_m)
        row = 0.5 * (e.near_px + e.far_px);
    }
    best.pixel = {column_px(block), top_ + row};
    if (const auto ice = camera_.paint_at(best.pixel)) {
      best.ice = *ice;
      found.push_back(best);
    }
    best_row = -1;
  };

  for (int r = 0; r < rows_; r += row_step(thickness[r])) {
    const auto p = profile(block, r);
    if (!p) continue;
    if (best_row >= 0 && r - best_row > std::max(2, static_cast<int>(thickness[r] / 2.0F))) keep();
    const float strength = p->strength();
    if (strength < weakest || (best_row >= 0 && static_cast<double>(strength) <= best.strength)) continue;
    best.column = block;
    best.strength = static_cast<double>(strength);
    best.contrast = static_cast<double>(std::clamp(p->taken / std::max(thickness[r], 0.1F), 0.0F, 1.0F));
    best_row = r;
    best_level = 0.5F * (std::min(p->above, p->below) + p->inside);
  }
  keep();
}

HogRidgeFinder::Edges HogRidgeFinder::edges(int block, int row, double level) const {
  const float* light = &light_[index_of(block, rows_, 0)];
  const auto crossing = [&](int step) {
    int r = row;
    while (r + step >= 0 && r + step < rows_ && static_cast<double>(light[r + step]) < level) r += step;
    if (r + step < 0 || r + step >= rows_) return static_cast<double>(r);
    const double rise = static_cast<double>(light[r + step] - light[r]);
    return r + step * (rise > 0.0 ? std::clamp((level - static_cast<double>(light[r])) / rise, 0.0, 1.0) : 0.0);
  };
  return {crossing(-1), crossing(1)};
}

}  // namespace hogline::vision
