#include "src/drawing/picture_overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/drawing/canvas.hpp"

namespace hogline::drawing {
namespace {

using PolyLines = std::vector<std::vector<Eigen::Vector2d>>;

constexpr Ink hog_ink{255, 150, 0};
constexpr Ink left_ink{120, 210, 255};
constexpr Ink right_ink{255, 140, 215};
constexpr Ink ring_ink{255, 235, 60};
constexpr Ink point_ink{255, 70, 50};
constexpr Ink model_ink{60, 235, 120};
constexpr Ink candidate_ink{255, 200, 120};
constexpr Ink panel_ink{18, 22, 28};
constexpr Ink panel_text{240, 243, 246};

// One entry of the legend: a short line or a dot, and what it means.
struct Key {
  std::string name;
  Ink ink;
  bool dot;
};

double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

std::vector<std::string> words(const SheetPosePercept& p) {
  if (!p.ok) return {"not seen: " + (p.reason.empty() ? std::string("no reason given") : p.reason)};
  std::vector<std::string> lines{
      fmt::format("yaw  {:+.3f} deg  (sigma {:.3f})", degrees(p.body.yaw_rad), degrees(p.sigma.yaw_rad)),
      fmt::format("x  {:+.3f} m  (sigma {:.3f})", p.body.x_m, p.sigma.x_m),
      fmt::format("y  {:+.3f} m  (sigma {:.3f})", p.body.y_m, p.sigma.y_m),
      fmt::format("hog line in  {:.3f} m  (sigma {:.3f})", p.hog_distance_m, p.hog_distance_sigma_m),
      p.sheet_width_m ? fmt::format("sheet width  {:.3f} m", *p.sheet_width_m) : std::string("sheet width not seen"),
      fmt::format("residual  {:.2f} px at {} places", p.residual_px, p.sites_used)};
  return lines;
}

// A dark panel in the upper left corner: title, pose, legend. Sized for a picture 1600 pixels wide.
void draw_panel(Canvas& canvas, const std::string& title, const SheetPosePercept& percept,
                const std::vector<Key>& keys) {
  const double unit = std::max(6.0, canvas.size().width / 1600.0 * 13.0);
  const auto lines = words(percept);
  double width = Canvas::text_width_px(title, 1.25 * unit);
  for (const auto& line : lines) width = std::max(width, Canvas::text_width_px(line, unit));
  for (const auto& key : keys) width = std::max(width, 3.4 * unit + Canvas::text_width_px(key.name, unit));
  const double step = 1.95 * unit;
  const double height = step * static_cast<double>(lines.size() + keys.size()) + 4.9 * unit;
  canvas.box({unit, unit}, {width + 3.2 * unit, unit + height}, panel_ink, 0.78);

  const double x = 2.1 * unit;
  double y = 3.4 * unit;
  canvas.text({x, y}, title, 1.25 * unit, percept.ok ? model_ink : point_ink, {Anchor::left, true, {}});
  y += 0.4 * unit;
  for (const auto& line : lines) canvas.text({x, y += step}, line, unit, panel_text);
  y += 0.6 * unit;
  for (const Key& key : keys) {
    y += step;
    if (key.dot) {
      canvas.disc({x + 1.2 * unit, y - 0.5 * unit}, 0.42 * unit, key.ink);
    } else {
      canvas.line({x, y - 0.5 * unit}, {x + 2.4 * unit, y - 0.5 * unit}, key.ink, 0.28 * unit);
    }
    canvas.text({x + 3.4 * unit, y}, key.name, unit, panel_text);
  }
}

void draw_lines(Canvas& canvas, const PolyLines& lines, const Ink& ink, double width_px) {
  for (const auto& line : lines) canvas.poly_line(line, ink, width_px);
}

// Dark underneath, so that it can be told from ice and from paint.
void draw_clearly(Canvas& canvas, const PolyLines& lines, const Ink& ink, double width_px) {
  draw_lines(canvas, lines, panel_ink, width_px + 2.0);
  draw_lines(canvas, lines, ink, width_px);
}

void draw_point(Canvas& canvas, const Eigen::Vector2d& at, const std::string& name, double unit) {
  canvas.disc(at, 0.62 * unit, panel_ink);
  canvas.disc(at, 0.46 * unit, point_ink);
  canvas.circle(at, 1.0 * unit, point_ink, 2.0);
  const Eigen::Vector2d beside = at + Eigen::Vector2d(1.3 * unit, -0.9 * unit);
  for (const auto& [dx, dy] : {std::pair{-1.5, 0.0}, {1.5, 0.0}, {0.0, -1.5}, {0.0, 1.5}}) {
    canvas.text(beside + Eigen::Vector2d(dx, dy), name, 1.2 * unit, panel_ink, {Anchor::left, true, {}});
  }
  canvas.text(beside, name, 1.2 * unit, ring_ink, {Anchor::left, true, {}});
}

double unit_of(const Canvas& canvas) { return std::max(6.0, canvas.size().width / 1600.0 * 13.0); }

}  // namespace

cv::Mat draw_near_view(const cv::Mat& picture, const SheetPosePercept& percept, const vision::NearViewSketch& sketch,
                       const std::string& title) {
  Canvas canvas(picture);
  const double unit = unit_of(canvas);
  draw_lines(canvas, sketch.hog_candidates, hog_ink, 2.0);
  draw_lines(canvas, sketch.left_candidates, left_ink, 2.0);
  draw_lines(canvas, sketch.right_candidates, right_ink, 2.0);
  for (const auto& p : sketch.ring_contour) canvas.disc(p, 1.6, ring_ink);
  draw_clearly(canvas, sketch.model, model_ink, 2.0);
  for (std::size_t i = 0; i < sketch.four_points.size(); ++i) {
    draw_point(canvas, sketch.four_points[i], std::to_string(i + 1), unit);
  }

  draw_panel(canvas, title, percept,
             {{"hog line candidates", hog_ink, false},
              {"left sideline candidates", left_ink, false},
              {"right sideline candidates", right_ink, false},
              {"outer ring, segmented", ring_ink, true},
              {"four tangency points", point_ink, true},
              {"painted sheet at this pose", model_ink, false}});
  return canvas.picture();
}

cv::Mat draw_low_view(const cv::Mat& picture, const SheetPosePercept& percept, const vision::LowViewSketch& sketch,
                      const std::string& title) {
  Canvas canvas(picture);
  draw_lines(canvas, sketch.candidates, candidate_ink, 2.0);
  draw_clearly(canvas, sketch.chosen, hog_ink, 4.0);
  draw_clearly(canvas, sketch.model, model_ink, 2.0);

  draw_panel(canvas, title, percept,
             {{"candidates", candidate_ink, false},
              {"chosen lines", hog_ink, false},
              {"painted sheet at this pose", model_ink, false}});
  return canvas.picture();
}

}  // namespace hogline::drawing
