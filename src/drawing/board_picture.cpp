#include "src/drawing/board_picture.hpp"

#include <cmath>
#include <numbers>

#include "src/drawing/canvas.hpp"
#include "src/drawing/sheet_plan.hpp"

namespace hogline::drawing {
namespace {

constexpr double from_y_m = -2.6;
constexpr double to_y_m = 7.0;
constexpr int outline_points = 48;
constexpr double half_bar_m = 0.075;    // of a grip
constexpr double bar_height_m = 0.059;  // over the handle's rim

Ink ink_of(Team team) {
  switch (team) {
    case Team::first:
      return inks::red;
    case Team::second:
      return inks::yellow;
    case Team::unknown:
      break;
  }
  return inks::faint;
}

template <typename Curve>
std::vector<Eigen::Vector2d> projected(const vision::SheetCamera& camera, const Curve& curve) {
  std::vector<Eigen::Vector2d> pixels;
  for (int i = 0; i <= outline_points; ++i) {
    const auto pixel = camera.project(curve(2.0 * std::numbers::pi * i / outline_points));
    if (!pixel) return {};
    pixels.push_back(*pixel);
  }
  return pixels;
}

std::vector<Eigen::Vector2d> bar_of(const vision::SheetCamera& camera, const vision::StoneShape& shape,
                                    const Eigen::Vector2d& place, double handle_rad) {
  const Eigen::Vector2d along = half_bar_m * Eigen::Vector2d(-std::sin(handle_rad), std::cos(handle_rad));
  std::vector<Eigen::Vector2d> pixels;
  for (const double end : {-1.0, 1.0}) {
    const Eigen::Vector2d p = place + end * along;
    const auto pixel = camera.project({p.x(), p.y(), shape.handle_height_m + bar_height_m});
    if (!pixel) return {};
    pixels.push_back(*pixel);
  }
  return pixels;
}

}  // namespace

cv::Mat draw_stones(const cv::Mat& picture, const vision::Board& board, const vision::SheetCamera& camera,
                    const vision::StoneShape& shape) {
  Canvas canvas(picture);
  const Eigen::Vector3d eye = camera.eMc().translation();
  for (const vision::RuledStone& s : board.stones) {
    const Eigen::Vector2d place(s.seen.x_m, s.seen.y_m);
    const vision::Bearing bearing = vision::bearing_of(place, eye);
    const Ink ink = ink_of(s.seen.team);
    canvas.poly_line(projected(camera, [&](double a) { return vision::body_outline_point(place, shape, eye, a); }),
                     inks::sky, 1.5);
    canvas.poly_line(projected(camera,
                               [&](double a) {
                                 return vision::circle_point(place, bearing, shape.handle_radius_m,
                                                             shape.handle_height_m, a);
                               }),
                     ink, 2.0);
    if (s.seen.handle_rad) canvas.poly_line(bar_of(camera, shape, place, *s.seen.handle_rad), inks::paper, 1.5);
    const auto above = camera.project({place.x(), place.y(), shape.handle_height_m + 0.12});
    if (above && s.order > 0) {
      canvas.text(*above, std::to_string(s.order), 14.0, ink,
                  {.anchor = Anchor::centre, .bold = true, .halo = inks::text});
    }
  }
  return canvas.picture();
}

cv::Mat draw_board(const vision::Board& board, std::optional<double> sheet_width_m, int length_px) {
  SheetPlan plan;
  plan.title = board.shot ? "shot stone ringed, numbered by distance" : "no stone in the house";
  plan.width_m = sheet_width_m.value_or(vision::rules::nominal_width_m);
  plan.direction = ThrowDirection::up;
  plan.from_y_m = from_y_m;
  plan.to_y_m = to_y_m;
  for (std::size_t i = 0; i < board.stones.size(); ++i) {
    const vision::RuledStone& s = board.stones[i];
    PlanStone stone;
    stone.place_m = {s.seen.x_m, s.seen.y_m};
    stone.handle_rad = s.seen.handle_rad;
    stone.team = ink_of(s.seen.team);
    stone.label = s.order > 0 ? std::to_string(s.order) : std::string();
    stone.ringed = board.shot && *board.shot == i;
    plan.stones.push_back(stone);
  }
  return draw_sheet_plan(plan, length_px);
}

}  // namespace hogline::drawing
