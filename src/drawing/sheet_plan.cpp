#include "src/drawing/sheet_plan.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace hogline::drawing {
namespace {

namespace rules = vision::rules;

constexpr Ink ice{241, 246, 250};
constexpr Ink outside{214, 222, 230};
constexpr Ink line_ink{70, 78, 88};
constexpr Ink hog_ink{200, 60, 50};
constexpr Ink granite{118, 122, 128};
constexpr double title_px = 11.0;
constexpr double label_px = 9.0;
constexpr double head_px = 48.0;  // title and legend
constexpr double foot_px = 26.0;  // the scale
constexpr double side_px = 14.0;
constexpr double scale_px = 34.0;  // beside a tall sheet: the numbers
constexpr double beside_m = 0.25;  // shown beyond the sidelines

// From metres in e to the picture.
struct Map {
  ThrowDirection direction;
  double scale;  // px per metre
  Eigen::Vector2d origin_px;
  double from_y_m;

  Eigen::Vector2d at(const Eigen::Vector2d& e) const {
    const double along = scale * (e.y() - from_y_m);
    const double right = scale * e.x();
    return direction == ThrowDirection::right ? Eigen::Vector2d(origin_px.x() + along, origin_px.y() + right)
                                              : Eigen::Vector2d(origin_px.x() + right, origin_px.y() - along);
  }
  std::vector<Eigen::Vector2d> all(const std::vector<Eigen::Vector2d>& points) const {
    std::vector<Eigen::Vector2d> places;
    places.reserve(points.size());
    for (const auto& p : points) places.push_back(at(p));
    return places;
  }
};

struct Layout {
  cv::Size size;
  Map map;
};

Layout layout_of(const SheetPlan& plan, int length_px) {
  const bool wide = plan.direction == ThrowDirection::right;
  const double room_px = wide ? length_px - 2.0 * side_px : length_px - head_px - foot_px;
  const double scale = room_px / (plan.to_y_m - plan.from_y_m);
  const double across_px = scale * (plan.width_m + 2.0 * beside_m);
  if (wide) {
    return {{length_px, static_cast<int>(std::ceil(across_px + head_px + foot_px))},
            {plan.direction, scale, {side_px, head_px + 0.5 * across_px}, plan.from_y_m}};
  }
  const double width = std::max(across_px + 2.0 * scale_px, 300.0);
  return {{static_cast<int>(std::ceil(width)), length_px},
          {plan.direction, scale, {0.5 * width, length_px - foot_px}, plan.from_y_m}};
}

void draw_strip(Canvas& canvas, const Map& map, double x0, double x1, double y0, double y1, const Ink& ink) {
  canvas.polygon(map.all({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}), ink);
}

void draw_paint(Canvas& canvas, const SheetPlan& plan, const Map& map) {
  const double half = 0.5 * plan.width_m;
  const double from = plan.from_y_m;
  const double to = plan.to_y_m;
  draw_strip(canvas, map, -half - beside_m, half + beside_m, from, to, outside);
  draw_strip(canvas, map, -half, half, from, to, ice);
  for (const double tee : {0.0, rules::tee_to_tee_m}) {
    if (tee + rules::outer_ring_radius_m > to || tee - rules::outer_ring_radius_m < from) continue;
    for (std::size_t i = 0; i < 4; ++i)
      canvas.disc(map.at(Eigen::Vector2d(0.0, tee)), map.scale * rules::ring_radii_m[i], plan.rings[i]);
  }
  for (const auto& line : vision::cross_lines()) {
    if (line.centre_y_m() < from || line.centre_y_m() > to) continue;
    const bool hog = line.name.find("hog") != std::string_view::npos;
    canvas.line(map.at(Eigen::Vector2d(-half, line.centre_y_m())), map.at(Eigen::Vector2d(half, line.centre_y_m())),
                hog ? hog_ink : line_ink, std::max(1.0, line.width_m() * map.scale));
  }
  const double begin = std::max(from, vision::centre_line_begin_y_m);
  const double end = std::min(to, vision::centre_line_end_y_m);
  canvas.line(map.at(Eigen::Vector2d(0.0, begin)), map.at(Eigen::Vector2d(0.0, end)), line_ink, 1.0);
  for (const double side : {-half, half}) {
    canvas.line(map.at(Eigen::Vector2d(side, from)), map.at(Eigen::Vector2d(side, to)), line_ink, 1.5);
  }
}

void draw_hacks(Canvas& canvas, const SheetPlan& plan, const Map& map) {
  for (const double y : {-rules::tee_to_hack_m, rules::tee_to_tee_m + rules::tee_to_hack_m}) {
    if (y - 0.2 < plan.from_y_m || y + 0.2 > plan.to_y_m) continue;
    for (const double side : {-1.0, 1.0}) draw_strip(canvas, map, side * 0.08, side * 0.23, y - 0.1, y + 0.1, line_ink);
  }
}

// Metres along the sheet, from the tee.
void draw_scale(Canvas& canvas, const SheetPlan& plan, const Map& map) {
  const double step = map.scale > 60.0 ? 1.0 : 5.0;
  const double half = 0.5 * plan.width_m + beside_m;
  for (double y = std::ceil(plan.from_y_m / step) * step; y <= plan.to_y_m; y += step) {
    const Eigen::Vector2d edge = map.at(Eigen::Vector2d(plan.direction == ThrowDirection::right ? half : -half, y));
    const std::string number = std::to_string(static_cast<int>(std::lround(y)));
    if (plan.direction == ThrowDirection::right) {
      canvas.line(edge, edge + Eigen::Vector2d(0.0, 4.0), inks::faint, 1.0);
      canvas.text(edge + Eigen::Vector2d(0.0, 16.0), number + (y == 0.0 ? " m from the tee" : ""), 8.0, inks::text,
                  {y == 0.0 ? Anchor::left : Anchor::centre, false, {}});
    } else {
      canvas.line(edge, edge - Eigen::Vector2d(4.0, 0.0), inks::faint, 1.0);
      canvas.text(edge + Eigen::Vector2d(-7.0, 4.0), number, 8.0, inks::text, {Anchor::right, false, {}});
    }
  }
}

// The part of a track between two places along the sheet.
std::vector<Eigen::Vector2d> within(const std::vector<Eigen::Vector2d>& track, double from, double to) {
  std::vector<Eigen::Vector2d> part;
  for (std::size_t i = 1; i < track.size(); ++i) {
    const Eigen::Vector2d& a = track[i - 1];
    const Eigen::Vector2d step = track[i] - a;
    const double t0 = step.y() == 0.0 ? 0.0 : std::min((from - a.y()) / step.y(), (to - a.y()) / step.y());
    const double t1 = step.y() == 0.0 ? 1.0 : std::max((from - a.y()) / step.y(), (to - a.y()) / step.y());
    const double begin = std::max(0.0, t0);
    const double end = std::min(1.0, t1);
    const bool seen =
        begin < end && a.y() + 0.5 * (begin + end) * step.y() >= from && a.y() + 0.5 * (begin + end) * step.y() <= to;
    if (!seen) continue;  // also where a point is not finite
    part.push_back(a + begin * step);
    part.push_back(a + end * step);
    part.push_back(Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
  return part;
}

void draw_stone(Canvas& canvas, const PlanStone& stone, const Map& map) {
  const Eigen::Vector2d at = map.at(stone.place_m);
  const double radius = std::max(4.0, map.scale * rules::stone_radius_m);
  canvas.disc(at, radius, granite);
  canvas.disc(at, 0.72 * radius, stone.team);
  if (radius >= 7.0 && stone.handle_rad) {
    const Eigen::Vector2d bar(-std::sin(*stone.handle_rad), std::cos(*stone.handle_rad));
    const Eigen::Vector2d half = (map.at(Eigen::Vector2d(stone.place_m + bar)) - at).normalized() * 0.55 * radius;
    canvas.line(at - half, at + half, inks::paper, std::max(1.5, 0.22 * radius));
  }
  if (stone.ringed) canvas.circle(at, radius + 2.5, inks::text, 1.2);
  if (!stone.label.empty())
    canvas.text(at + Eigen::Vector2d(radius + 6.0, 0.5 * label_px), stone.label, label_px, inks::text,
                {Anchor::left, false, inks::paper});
}

void draw_ellipse(Canvas& canvas, const PlanEllipse& ellipse, const Map& map) {
  if (!ellipse.covariance_m2.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(ellipse.covariance_m2);
  const Eigen::Vector2d length = ellipse.sigmas * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i <= 72; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 72.0;
    outline.push_back(ellipse.place_m +
                      axes.eigenvectors() * Eigen::Vector2d(length.x() * std::cos(a), length.y() * std::sin(a)));
  }
  const auto places = map.all(outline);
  canvas.polygon(places, ellipse.ink, 0.18);
  canvas.poly_line(places, ellipse.ink, 1.3);
}

void draw_mark(Canvas& canvas, const PlanMark& mark, const Map& map) {
  const Eigen::Vector2d at = map.at(mark.place_m);
  canvas.circle(at, 5.0, mark.ink, 1.6);
  canvas.disc(at, 1.8, mark.ink);
  canvas.text(at + Eigen::Vector2d(9.0, -7.0), mark.name, label_px, mark.ink, {Anchor::left, true, inks::paper});
}

void draw_head(Canvas& canvas, const SheetPlan& plan) {
  canvas.text({side_px, 19.0}, plan.title, title_px, inks::text, {Anchor::left, true, {}});
  double x = side_px;
  for (const PlanTrack& track : plan.tracks) {
    if (track.name.empty()) continue;
    canvas.poly_line({{x, 35.0}, {x + 22.0, 35.0}}, track.ink, 2.0, track.dashed ? 5.0 : 0.0);
    canvas.text({x + 28.0, 35.0 + 0.5 * label_px}, track.name, label_px, inks::text);
    x += 28.0 + Canvas::text_width_px(track.name, label_px) + 20.0;
  }
}

}  // namespace

cv::Mat draw_sheet_plan(const SheetPlan& plan, int length_px) {
  assert(plan.from_y_m < plan.to_y_m && plan.width_m > 0.0 && length_px >= 200);
  const Layout layout = layout_of(plan, length_px);
  Canvas canvas(layout.size, inks::paper);

  draw_paint(canvas, plan, layout.map);
  draw_hacks(canvas, plan, layout.map);
  draw_scale(canvas, plan, layout.map);
  for (const PlanEllipse& ellipse : plan.ellipses) draw_ellipse(canvas, ellipse, layout.map);
  for (const PlanTrack& track : plan.tracks) {
    canvas.poly_line(layout.map.all(within(track.points_m, plan.from_y_m, plan.to_y_m)), track.ink, 2.0,
                     track.dashed ? 6.0 : 0.0);
  }
  const auto shown = [&plan](const Eigen::Vector2d& p) { return p.y() >= plan.from_y_m && p.y() <= plan.to_y_m; };
  for (const PlanStone& stone : plan.stones) {
    if (shown(stone.place_m)) draw_stone(canvas, stone, layout.map);
  }
  for (const PlanMark& mark : plan.marks) {
    if (shown(mark.place_m)) draw_mark(canvas, mark, layout.map);
  }
  draw_head(canvas, plan);
  return canvas.picture();
}

}  // namespace hogline::drawing
