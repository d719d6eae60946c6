#include "src/drawing/plot.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>

#include <opencv2/core.hpp>

namespace hogline::drawing {
namespace {

constexpr double title_px = 11.0;
constexpr double label_px = 9.0;
constexpr double tick_px = 8.0;
constexpr double left_px = 72.0;
constexpr double right_px = 18.0;
constexpr double top_px = 50.0;
constexpr double bottom_px = 46.0;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool empty() const { return !(low <= high); }
  bool holds(double v) const { return v >= low && v <= high; }
  void include(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

std::size_t points(const Series& s) { return std::min(s.x.size(), s.y.size()); }

struct Ranges {
  Range x;
  Range y;
};

// Of what is finite.
Ranges ranges_of(const Plot& plot) {
  Ranges r;
  for (const Series& s : plot.series) {
    for (std::size_t i = 0; i < points(s); ++i) {
      if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
      r.x.include(s.x[i]);
      r.y.include(s.y[i]);
    }
  }
  return r;
}

// A range that can be drawn: not empty, not a single value, with some air around the data where asked for.
Range drawable(Range r, const std::optional<double>& low, const std::optional<double>& high, double air) {
  if (r.empty()) r = {0.0, 1.0};
  const double width = r.high - r.low;
  const double least = 1e-9 * std::max(1.0, std::max(std::abs(r.low), std::abs(r.high)));
  const double extra = width > least ? air * width : 0.5 * std::max(1e-3, std::abs(r.low) * 0.1);
  Range out{low.value_or(r.low - extra), high.value_or(r.high + extra)};
  if (!(out.low < out.high) || !std::isfinite(out.low) || !std::isfinite(out.high))
    out = {r.low - extra, r.high + extra};
  return out;
}

std::string number(double value, double step) {
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  char text[64];
  const bool huge = std::abs(value) >= 1e7;
  std::snprintf(text, sizeof text, huge ? "%.*e" : "%.*f", huge ? 2 : digits,
                std::abs(value) < 1e-9 * step ? 0.0 : value);
  return text;
}

// From values to places on the canvas.
struct Axes {
  Range x;
  Range y;
  Eigen::Vector2d corner;    // lower left
  Eigen::Vector2d opposite;  // upper right
  Eigen::Vector2d at(double vx, double vy) const {
    return {corner.x() + (vx - x.low) / (x.high - x.low) * (opposite.x() - corner.x()),
            corner.y() + (vy - y.low) / (y.high - y.low) * (opposite.y() - corner.y())};
  }
};

void draw_frame(Canvas& canvas, const Plot& plot, const Axes& axes) {
  const auto xs =
      axis_ticks(axes.x.low, axes.x.high, std::max(2, static_cast<int>((axes.opposite.x() - axes.corner.x()) / 90.0)));
  const auto ys =
      axis_ticks(axes.y.low, axes.y.high, std::max(2, static_cast<int>((axes.corner.y() - axes.opposite.y()) / 36.0)));
  const double step_x = xs.size() > 1 ? xs[1] - xs[0] : 1.0;
  const double step_y = ys.size() > 1 ? ys[1] - ys[0] : 1.0;
  for (const double v : xs) {
    const Eigen::Vector2d foot = axes.at(v, axes.y.low);
    canvas.line(foot, axes.at(v, axes.y.high), inks::grid, 1.0);
    canvas.text(foot + Eigen::Vector2d(0.0, 16.0), number(v, step_x), tick_px, inks::text, {Anchor::centre, false, {}});
  }
  for (const double v : ys) {
    const Eigen::Vector2d foot = axes.at(axes.x.low, v);
    const bool zero = std::abs(v) < 1e-9 * step_y;
    canvas.line(foot, axes.at(axes.x.high, v), zero ? inks::faint : inks::grid, 1.0);
    canvas.text(foot + Eigen::Vector2d(-8.0, 0.5 * tick_px), number(v, step_y), tick_px, inks::text,
                {Anchor::right, false, {}});
  }
  canvas.line(axes.corner, {axes.opposite.x(), axes.corner.y()}, inks::faint, 1.0);
  canvas.line(axes.corner, {axes.corner.x(), axes.opposite.y()}, inks::faint, 1.0);
  canvas.text({0.5 * (axes.corner.x() + axes.opposite.x()), axes.corner.y() + 36.0}, plot.x_label, label_px, inks::text,
              {Anchor::centre, false, {}});
  canvas.upright_text({14.0, 0.5 * (axes.corner.y() + axes.opposite.y())}, plot.y_label, label_px, inks::text);
  canvas.text({axes.corner.x(), 20.0}, plot.title, title_px, inks::text, {Anchor::left, true, {}});
}

void draw_sample(Canvas& canvas, const Series& s, const Eigen::Vector2d& at) {
  const Eigen::Vector2d end = at + Eigen::Vector2d(22.0, 0.0);
  if (s.style == SeriesStyle::dots) {
    canvas.disc(0.5 * (at + end), 2.5, s.ink);
  } else {
    canvas.poly_line({at, end}, s.ink, 2.0, s.style == SeriesStyle::dashed ? 5.0 : 0.0);
  }
}

void draw_legend(Canvas& canvas, const Plot& plot, const Axes& axes) {
  double x = axes.corner.x();
  for (const Series& s : plot.series) {
    if (s.name.empty()) continue;
    draw_sample(canvas, s, {x, 36.0});
    canvas.text({x + 28.0, 36.0 + 0.5 * label_px}, s.name, label_px, inks::text);
    x += 28.0 + Canvas::text_width_px(s.name, label_px) + 20.0;
  }
}

void draw_mark_lines(Canvas& canvas, const Plot& plot, const Axes& axes) {
  for (const PlotMark& mark : plot.marks) {
    if (!axes.x.holds(mark.x)) continue;
    canvas.poly_line({axes.at(mark.x, axes.y.low), axes.at(mark.x, axes.y.high)}, inks::faint, 1.0, 4.0);
  }
}

void draw_mark_names(Canvas& canvas, const Plot& plot, const Axes& axes) {
  for (const PlotMark& mark : plot.marks) {
    if (!axes.x.holds(mark.x)) continue;
    const bool at_the_end = mark.x > axes.x.low + 0.8 * (axes.x.high - axes.x.low);
    const Eigen::Vector2d beside(at_the_end ? -6.0 : 6.0, -7.0);
    canvas.text(axes.at(mark.x, axes.y.low) + beside, mark.name, tick_px, inks::text,
                {at_the_end ? Anchor::right : Anchor::left, false, inks::paper});
  }
}

// Values outside the frame are left out.
void draw_series(Canvas& canvas, const Series& s, const Axes& axes) {
  std::vector<Eigen::Vector2d> places;
  const Eigen::Vector2d gap = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < points(s); ++i) {
    const bool inside = s.x[i] >= axes.x.low && s.x[i] <= axes.x.high && s.y[i] >= axes.y.low && s.y[i] <= axes.y.high;
    places.push_back(inside ? axes.at(s.x[i], s.y[i]) : gap);
  }
  const bool alone = places.size() == 1;
  if (s.style == SeriesStyle::dots || alone) {
    for (const auto& p : places) canvas.disc(p, alone ? 3.0 : 1.8, s.ink);
    return;
  }
  canvas.poly_line(places, s.ink, 1.8, s.style == SeriesStyle::dashed ? 5.0 : 0.0);
}

}  // namespace

std::vector<double> axis_ticks(double low, double high, int wanted) {
  assert(std::isfinite(low) && std::isfinite(high) && low < high && wanted >= 1);
  const double rough = (high - low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double share = rough / power;
  const double step = power * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
  std::vector<double> ticks;
  const double first = std::ceil(low / step - 1e-9);
  for (int i = 0; i <= 2 * wanted + 2; ++i) {
    const double v = (first + i) * step;
    if (v > high + 1e-9 * step) break;
    ticks.push_back(v);
  }
  return ticks;
}

cv::Mat draw_plot(const Plot& plot, cv::Size size) {
  assert(size.width >= 200 && size.height >= 120);
  Canvas canvas(size, inks::paper);
  const Ranges data = ranges_of(plot);
  const Axes axes{drawable(data.x, plot.x_low, plot.x_high, 0.0),
                  drawable(data.y, plot.y_low, plot.y_high, 0.06),
                  {left_px, size.height - bottom_px},
                  {size.width - right_px, top_px}};

  draw_frame(canvas, plot, axes);
  draw_mark_lines(canvas, plot, axes);
  for (const Series& s : plot.series) draw_series(canvas, s, axes);
  draw_mark_names(canvas, plot, axes);
  draw_legend(canvas, plot, axes);
  if (data.x.empty())
    canvas.text(0.5 * (axes.corner + axes.opposite), "no data", title_px, inks::faint, {Anchor::centre, false, {}});
  return canvas.picture();
}

cv::Mat draw_plots(std::vector<Plot> plots, cv::Size size_of_each) {
  Range common;
  for (const Plot& plot : plots) {
    const Range x = ranges_of(plot).x;
    if (x.empty()) continue;
    common.include(x.low);
    common.include(x.high);
  }
  cv::Mat all(size_of_each.height * static_cast<int>(plots.size()), size_of_each.width, CV_8UC3, cv::Scalar::all(255));
  for (std::size_t i = 0; i < plots.size(); ++i) {
    if (!common.empty() && !plots[i].x_low) plots[i].x_low = common.low;
    if (!common.empty() && !plots[i].x_high) plots[i].x_high = common.high;
    draw_plot(plots[i], size_of_each)
        .copyTo(all.rowRange(static_cast<int>(i) * size_of_each.height, static_cast<int>(i + 1) * size_of_each.height));
  }
  return all;
}

}  // namespace hogline::drawing
