#include "src/campaign/resting_plot.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "src/campaign/summary.hpp"
#include "src/drawing/canvas.hpp"
#include "vision/geometry/sheet.hpp"

namespace hogline::campaign {
namespace {

using drawing::Canvas;
namespace inks = drawing::inks;

constexpr double px_per_m = 160.0;
const cv::Size size_px(720, 720);

Eigen::Vector2d pixel(double across_m, double along_m) {
  return {0.5 * size_px.width + px_per_m * across_m, 0.5 * size_px.height - px_per_m * along_m};
}

void draw_house(Canvas& canvas) {
  for (const double radius_m : vision::rules::ring_radii_m) {
    canvas.circle(pixel(0.0, 0.0), px_per_m * radius_m, inks::faint, 1.0);
  }
  canvas.line(pixel(-2.2, 0.0), pixel(2.2, 0.0), inks::grid, 1.0);
  canvas.line(pixel(0.0, -2.2), pixel(0.0, 2.2), inks::grid, 1.0);
}

void draw_ellipse(Canvas& canvas, double x_m, double y_m, double sigma_x_m, double sigma_y_m, const drawing::Ink& ink) {
  constexpr int steps = 90;
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i <= steps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / steps;
    outline.push_back(pixel(x_m + sigma_x_m * std::cos(angle), y_m + sigma_y_m * std::sin(angle)));
  }
  canvas.poly_line(outline, ink, 2.0);
}

}  // namespace

cv::Mat resting_places(const std::vector<Row>& rows) {
  Canvas canvas(size_px, inks::paper);
  draw_house(canvas);
  for (const Row& row : rows) {
    if (!row.rest_x_m || !row.rest_y_m) continue;
    canvas.disc(pixel(*row.rest_x_m, *row.rest_y_m - vision::rules::tee_to_tee_m), 3.0, inks::blue);
  }
  const Summary s = summarise(rows, true);
  draw_ellipse(canvas, s.across_m.mean, s.along_m.mean, s.across_m.sigma, s.along_m.sigma, inks::red);
  draw_ellipse(canvas, 0.0, 0.0, elite_across_sigma_m, elite_along_sigma_m, inks::orange);
  canvas.text(
      {12.0, 28.0},
      fmt::format("{} stones: one sigma {:.2f} m along, {:.2f} m across (red); elite players {:.2f} and {:.2f} m "
                  "(orange)",
                  s.along_m.count, s.along_m.sigma, s.across_m.sigma, elite_along_sigma_m, elite_across_sigma_m),
      9.0, inks::text);
  return canvas.picture();
}

}  // namespace hogline::campaign
