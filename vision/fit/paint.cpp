#include "vision/fit/paint.hpp"

#include <algorithm>
#include <cmath>

#include "vision/geometry/sheet.hpp"

namespace hogline::vision {
namespace {

using namespace rules;

PaintFeature across(std::size_t i) {
  const CrossLine& line = cross_lines()[i];
  return {line.name, PaintShape::across, line.near_edge_y_m, line.far_edge_y_m};
}

// The cut's crossings of one coordinate's value, kept when nearest on their side.
void meet(double distance_m, double per_px, Room& room) {
  if (std::abs(per_px) < 1e-12) return;
  const double s = distance_m / per_px;
  if (s >= 0.0) room.after_px = std::min(room.after_px, s);
  if (s <= 0.0) room.before_px = std::min(room.before_px, -s);
}

void meet_ring(const GroundCut& cut, double radius_m, double clear_px, Room& room) {
  const double r = cut.place.norm();
  const Eigen::Vector2d out = cut.place / std::max(r, 1e-9);
  const double clear_m = clear_px * (std::abs(out.dot(cut.per_px)) + std::abs(out.dot(cut.beside)));
  if (std::abs(r - radius_m) < clear_m) {
    room = {0.0, 0.0};
    return;
  }
  const double a = cut.per_px.squaredNorm();
  const double b = cut.place.dot(cut.per_px);
  const double discriminant = b * b - a * (r * r - radius_m * radius_m);
  if (discriminant <= 0.0 || a <= 0.0) return;
  for (const double root : {-b - std::sqrt(discriminant), -b + std::sqrt(discriminant)}) meet(root / a, 1.0, room);
}

void meet_band(const GroundCut& cut, int axis, double begin_m, double end_m, double clear_px, Room& room) {
  const double at = cut.place[axis];
  const double clear_m = clear_px * (std::abs(cut.per_px[axis]) + std::abs(cut.beside[axis]));
  if (at > begin_m - clear_m && at < end_m + clear_m) {
    room = {0.0, 0.0};
    return;
  }
  meet(begin_m - at, cut.per_px[axis], room);
  meet(end_m - at, cut.per_px[axis], room);
}

// Neighbouring sheets' sidelines run this far from ours at the nearest.
constexpr double neighbour_gap_m = 0.08;

}  // namespace

const std::array<PaintFeature, paint_feature_count>& paint_features() {
  static const std::array<PaintFeature, paint_feature_count> features{{
      {"outer_ring", PaintShape::ring, outer_ring_radius_m, 0.0},
      {"middle_ring", PaintShape::ring, middle_ring_radius_m, 0.0},
      {"inner_ring", PaintShape::ring, inner_ring_radius_m, 0.0},
      {"button", PaintShape::ring, button_radius_m, 0.0},
      across(0),
      across(1),
      across(2),
      across(3),
      across(4),
      across(5),
      {"centre_line", PaintShape::centre_line, -0.5 * thin_line_width_m, 0.5 * thin_line_width_m},
      {"left_sideline", PaintShape::sideline, -1.0, 0.0},
      {"right_sideline", PaintShape::sideline, 1.0, 0.0},
  }};
  return features;
}

Room room_around(const GroundCut& cut, int own, const FitState& state, double clear_px, double limit_px) {
  Room room{limit_px, limit_px};
  const auto& features = paint_features();
  for (int i = 0; i < paint_feature_count; ++i) {
    const PaintFeature& f = features[static_cast<std::size_t>(i)];
    if (f.shape == PaintShape::sideline) {
      const Sideline& side = state.sidelines[f.begin_m < 0.0 ? 0 : 1];
      if (!side.known) continue;
      const double inner = f.begin_m * side.edge_m;
      const double outer = f.begin_m * (side.edge_m + (side.is_line ? side.paint_m : 0.3));
      if (i != own) meet_band(cut, 0, std::min(inner, outer), std::max(inner, outer), clear_px, room);
      if (i == own) meet(outer + f.begin_m * neighbour_gap_m - cut.place.x(), cut.per_px.x(), room);
      continue;
    }
    if (i == own) continue;
    if (f.shape == PaintShape::ring) meet_ring(cut, f.begin_m, clear_px, room);
    if (f.shape == PaintShape::across) meet_band(cut, 1, f.begin_m, f.end_m, clear_px, room);
    if (f.shape == PaintShape::centre_line) meet_band(cut, 0, f.begin_m, f.end_m, clear_px, room);
  }
  return room;
}

}  // namespace hogline::vision
