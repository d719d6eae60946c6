#include "vision/fit/sideline_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hogline::vision {
namespace {

constexpr double step_m = 0.005;
constexpr int most_steps = 128;
constexpr int knot_steps = 5;  // projected exactly; between them the picture is straight to 0.05 px
constexpr int most_rows = 40;
constexpr double most_m_per_px = 0.015;  // a row whose pixel covers more than this across can not tell
constexpr double ice_m = 0.06;           // each row begins with this much ice
constexpr double beyond_m = 0.08;        // and ends with this much beyond the range
constexpr double most_paint_m = 0.10;
constexpr double least_paint_m = 0.008;

// One row of the sheet's cross section: how far each place's light is from the ice at the row's beginning.
struct Row {
  std::array<float, most_steps> unlike{};
  float most = 0.0F;
  float noise = 0.0F;
};

// A stretch unlike the ice.
struct Stretch {
  double begin_m;
  double length_m;
};

struct Stretches {
  static constexpr int most = 4 * most_rows;
  std::array<Stretch, most> at{};
  int count = 0;

  void add(const Stretch& stretch) {
    if (count < most) at[static_cast<std::size_t>(count++)] = stretch;
  }
};

bool read_row(const PictureLight& light, const SheetCamera& camera, double side, double y, double begin_m, int steps,
              Row& row) {
  std::array<std::array<float, 3>, most_steps> colour{};
  Profile one;
  std::optional<Eigen::Vector2d> from = camera.project_paint({side * begin_m, y});
  for (int i = 0; i < steps; i += knot_steps) {
    const auto to = camera.project_paint({side * (begin_m + (i + knot_steps) * step_m), y});
    if (!from || !to || knot_steps * step_m > most_m_per_px * (*to - *from).norm()) return false;
    for (int k = 0; k < knot_steps && i + k < steps; ++k) {
      const Eigen::Vector2d pixel = *from + (*to - *from) * k / knot_steps;
      if (!sample(light.picture, light.response, {pixel, {1.0, 0.0}, 0.0, 0.0, 1.0, 0}, one)) return false;
      for (std::size_t c = 0; c < static_cast<std::size_t>(one.channels); ++c) {
        colour[static_cast<std::size_t>(i + k)][c] = one.light[c][0];
      }
    }
    from = to;
  }
  constexpr int ice_steps = static_cast<int>(ice_m / step_m);
  std::array<float, 3> ice{};
  for (std::size_t i = 0; i < ice_steps; ++i) {
    for (std::size_t c = 0; c < 3; ++c) ice[c] += colour[i][c] / ice_steps;
  }
  row.most = row.noise = 0.0F;
  for (std::size_t i = 0; i < static_cast<std::size_t>(steps); ++i) {
    float sum = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) sum += (colour[i][c] - ice[c]) * (colour[i][c] - ice[c]);
    row.unlike[i] = std::sqrt(sum);
    row.most = std::max(row.most, row.unlike[i]);
    if (i < ice_steps) row.noise = std::max(row.noise, row.unlike[i]);
  }
  return true;
}

// Where the row's rise or fall crosses `level` between two samples.
double crossing_m(const Row& row, int before, float level, double begin_m) {
  const float a = row.unlike[static_cast<std::size_t>(before)];
  const float b = row.unlike[static_cast<std::size_t>(before + 1)];
  const float t = std::abs(b - a) > 1e-9F ? (level - a) / (b - a) : 0.5F;
  return begin_m + (before + static_cast<double>(t)) * step_m;
}

// A painted line is a narrow stretch; a divider goes on to the row's end or for long.
void collect(const Row& row, int steps, double begin_m, bool as_line, Stretches& stretches) {
  if (!(row.most > 0.02F && row.most > 4.0F * row.noise)) return;
  const float level = 0.5F * row.most;
  const auto above = [&](int i) { return row.unlike[static_cast<std::size_t>(i)] > level; };
  for (int i = 1; i < steps; ++i) {
    if (!above(i) || above(i - 1)) continue;
    int end = i;
    while (end < steps && above(end)) ++end;
    const double start = crossing_m(row, i - 1, level, begin_m);
    const double stop = end < steps ? crossing_m(row, end - 1, level, begin_m) : begin_m + end * step_m;
    const bool narrow = end < steps && stop - start < most_paint_m && stop - start > least_paint_m;
    const bool wide = stop - start > 0.06 || end == steps;
    if (as_line ? narrow : wide) stretches.add({start, stop - start});
    i = end;
  }
}

constexpr double together_m = 0.012;

int neighbours_of(const Stretches& stretches, double begin_m) {
  int n = 0;
  for (int i = 0; i < stretches.count; ++i) {
    n += std::abs(stretches.at[static_cast<std::size_t>(i)].begin_m - begin_m) < together_m ? 1 : 0;
  }
  return n;
}

}  // namespace

Sideline scan_sideline(const PictureLight& light, const SheetCamera& camera, double side, bool as_line,
                       const ScanRange& range) {
  Sideline found;
  found.is_line = as_line;
  const double begin_m = range.begin_m - ice_m;
  const int steps = std::min(most_steps, static_cast<int>((range.end_m + beyond_m + most_paint_m - begin_m) / step_m));
  const double y0 = camera.eMc().translation().y() + range.first_row_m;
  Stretches stretches;
  Row row;
  int rows = 0;
  for (int k = 0; k < 60 && rows < most_rows; ++k) {
    if (!read_row(light, camera, side, y0 + k * range.row_step_m, begin_m, steps, row)) continue;
    ++rows;
    collect(row, steps, begin_m, as_line, stretches);
  }

  // People's outlines lie elsewhere in each row; lines and dividers do not. The innermost place of many rows is ours.
  int most = 0;
  for (int i = 0; i < stretches.count; ++i) {
    const Stretch& s = stretches.at[static_cast<std::size_t>(i)];
    if (s.begin_m < range.end_m) most = std::max(most, neighbours_of(stretches, s.begin_m));
  }
  if (most < 4) return found;
  double innermost = range.end_m;
  for (int i = 0; i < stretches.count; ++i) {
    const double at = stretches.at[static_cast<std::size_t>(i)].begin_m;
    if (at > range.begin_m && at < innermost && neighbours_of(stretches, at) >= (most + 1) / 2) innermost = at;
  }
  double edge_sum = 0.0;
  double paint_sum = 0.0;
  int n = 0;
  for (int i = 0; i < stretches.count; ++i) {
    const Stretch& s = stretches.at[static_cast<std::size_t>(i)];
    if (s.begin_m < innermost - 1e-9 || s.begin_m > innermost + 2.0 * together_m) continue;
    edge_sum += s.begin_m;
    paint_sum += s.length_m;
    ++n;
  }
  if (n < 4) return found;
  found.known = true;
  found.edge_m = edge_sum / n;
  found.paint_m = std::clamp(paint_sum / n, 0.01, 0.09);
  return found;
}

}  // namespace hogline::vision
