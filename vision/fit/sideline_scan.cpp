#include "vision/fit/sideline_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr double step_m = 0.005;
constexpr int most_steps = 128;
constexpr int most_rows = 24;
constexpr double row_step_m = 0.3;
constexpr double most_coarse_px_m = 0.02;  // a row whose pixel covers more than this across can not tell

using Section = std::array<std::array<float, most_steps>, 3>;

struct Rows {
  std::array<Section, most_rows> light;
  int count = 0;
};

bool read_row(const PictureLight& light, const SheetCamera& camera, double side, double y, double begin_m, int steps,
              Section& row) {
  Profile one;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  for (int i = 0; i < steps; ++i) {
    const auto pixel = camera.project_paint({side * (begin_m + i * step_m), y});
    if (!pixel || !sample(light.picture, light.response, {*pixel, {1.0, 0.0}, 0.0, 0.0, 1.0, 0}, one)) return false;
    if (i > 0 && step_m / std::max((*pixel - last).norm(), 1e-9) > most_coarse_px_m) return false;
    last = *pixel;
    for (std::size_t c = 0; c < 3; ++c) {
      row[c][static_cast<std::size_t>(i)] = c < static_cast<std::size_t>(one.channels) ? one.light[c][0] : 0.0F;
    }
  }
  return true;
}

Section median_of(const Rows& rows, int steps) {
  Section section{};
  std::array<float, most_rows> values{};
  const auto n = static_cast<std::ptrdiff_t>(rows.count);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(steps); ++i) {
      for (int r = 0; r < rows.count; ++r)
        values[static_cast<std::size_t>(r)] = rows.light[static_cast<std::size_t>(r)][c][i];
      std::nth_element(values.begin(), values.begin() + n / 2, values.begin() + n);
      section[c][i] = values[static_cast<std::size_t>(n / 2)];
    }
  }
  return section;
}

// The section's difference from the ice at its inner end.
std::array<float, most_steps> unlike_ice(const Section& section, int steps, int ice_steps) {
  std::array<float, 3> ice{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (int i = 0; i < ice_steps; ++i)
      ice[c] += section[c][static_cast<std::size_t>(i)] / static_cast<float>(ice_steps);
  }
  std::array<float, most_steps> unlike{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(steps); ++i) {
    float sum = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) sum += (section[c][i] - ice[c]) * (section[c][i] - ice[c]);
    unlike[i] = std::sqrt(sum);
  }
  return unlike;
}

}  // namespace

Sideline scan_sideline(const PictureLight& light, const SheetCamera& camera, double side, bool as_line,
                       const ScanRange& range) {
  Sideline found;
  found.is_line = as_line;
  constexpr double ice_m = 0.06;
  constexpr double beyond_m = 0.07;
  const double begin_m = range.begin_m - ice_m;
  const int steps = std::min(most_steps, static_cast<int>((range.end_m + beyond_m - begin_m) / step_m));
  static thread_local Rows rows;
  rows.count = 0;
  const double y0 = camera.eMc().translation().y();
  for (int k = 0; k < 60 && rows.count < most_rows; ++k) {
    Section& row = rows.light[static_cast<std::size_t>(rows.count)];
    if (read_row(light, camera, side, y0 + k * row_step_m, begin_m, steps, row)) ++rows.count;
  }
  if (rows.count < 4) return found;

  const auto ice_steps = static_cast<int>(ice_m / step_m);
  const auto unlike = unlike_ice(median_of(rows, steps), steps, ice_steps);
  const float most = *std::max_element(unlike.begin(), unlike.begin() + steps);
  const float noise = *std::max_element(unlike.begin(), unlike.begin() + ice_steps);
  if (!(most > 0.03F && most > 3.0F * noise)) return found;

  // The first stretch that differs by more than half of the most; its half height is the edge.
  int i = 0;
  while (unlike[static_cast<std::size_t>(i)] < 0.5F * most) ++i;
  int peak = i;
  while (peak + 1 < steps && unlike[static_cast<std::size_t>(peak + 1)] > unlike[static_cast<std::size_t>(peak)])
    ++peak;
  const float half = 0.5F * unlike[static_cast<std::size_t>(peak)];
  int inner = peak;
  while (inner > 0 && unlike[static_cast<std::size_t>(inner - 1)] > half) --inner;
  int outer = peak;
  while (outer + 1 < steps && unlike[static_cast<std::size_t>(outer + 1)] > half) ++outer;
  found.edge_m = begin_m + (inner - 0.5) * step_m;
  found.known = found.edge_m > range.begin_m - step_m && found.edge_m < range.end_m + step_m;
  found.paint_m = std::clamp((outer - inner + 1) * step_m, 0.01, 0.09);
  if (as_line && outer + 1 >= steps) found.known = false;
  return found;
}

}  // namespace hogline::vision
