#include "vision/low_view_sketch.hpp"

#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {
namespace {

using PolyLine = std::vector<Eigen::Vector2d>;
constexpr int pieces = 32;

PolyLine bent(const ClassifiedLine& classified, const GroundView& view) {
  PolyLine poly;
  for (int i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const Eigen::Vector2d n = (1.0 - t) * classified.line.begin + t * classified.line.end;
    if (const auto pixel = view.pixel_of_plane(n)) poly.push_back(*pixel);
  }
  return poly;
}

PolyLine bent(const CrossCandidate& hog, const GroundView& view) {
  const SheetCamera camera(view.lens(), view.gMc(), view.setup().ice);
  PolyLine poly;
  for (int i = 0; i <= pieces; ++i) {
    const double x = hog.begin_x_m + (hog.end_x_m - hog.begin_x_m) * i / pieces;
    if (const auto pixel = camera.project_paint(hog.at(x))) poly.push_back(*pixel);
  }
  return poly;
}

}  // namespace

void draw_candidates(const std::vector<CrossCandidate>& hog_lines, const std::vector<ClassifiedLine>& down_ice,
                     const GroundView& view, LowViewSketch& sketch) {
  for (const auto& c : hog_lines) sketch.candidates.push_back(bent(c, view));
  for (const auto& c : down_ice) sketch.candidates.push_back(bent(c, view));
}

void draw_chosen(const HShape& h, const GroundView& view, LowViewSketch& sketch) {
  sketch.chosen.push_back(bent(h.hog, view));
  for (const auto* line : {&h.left, &h.right, &h.centre}) {
    if (*line) sketch.chosen.push_back(bent(**line, view));
  }
}

}  // namespace hogline::vision
