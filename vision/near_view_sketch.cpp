#include "vision/near_view_sketch.hpp"

#include <algorithm>
#include <cmath>

#include "vision/geometry/sheet.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {
namespace {

using PolyLine = std::vector<Eigen::Vector2d>;

PolyLine bent(const LineCandidate& line, const GroundView& view) {
  constexpr int pieces = 24;
  PolyLine poly;
  for (int i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    if (const auto pixel = view.pixel_of_plane((1.0 - t) * line.begin + t * line.end)) poly.push_back(*pixel);
  }
  return poly;
}

// A straight line on the sheet in short pieces: the lens bends it.
std::vector<Eigen::Vector2d> stretch(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const int pieces = std::max(1, static_cast<int>((to - from).norm() / 0.05));
  std::vector<Eigen::Vector2d> curve;
  for (int i = 0; i <= pieces; ++i) curve.push_back(from + static_cast<double>(i) / pieces * (to - from));
  return curve;
}

// The parts of a painted curve that lie in the picture.
void add_visible(const std::vector<Eigen::Vector2d>& curve, const SheetCamera& camera, std::vector<PolyLine>& lines) {
  PolyLine line;
  for (const Eigen::Vector2d& paint : curve) {
    const auto pixel = camera.project_paint(paint);
    if (pixel && camera.lens().in_picture(*pixel)) {
      line.push_back(*pixel);
    } else if (line.size() > 1) {
      lines.push_back(std::move(line));
      line = {};
    } else {
      line.clear();
    }
  }
  if (line.size() > 1) lines.push_back(std::move(line));
}

}  // namespace

void draw_candidates(const LineClasses& classes, const GroundView& view, NearViewSketch& sketch) {
  for (const auto& c : classes.hog) sketch.hog_candidates.push_back(bent(c.line, view));
  for (const auto& c : classes.left) sketch.left_candidates.push_back(bent(c.line, view));
  for (const auto& c : classes.right) sketch.right_candidates.push_back(bent(c.line, view));
}

void draw_model(const Pose& eMc, const CameraSetup& setup, std::optional<double> width_m, NearViewSketch& sketch) {
  sketch.model = model_lines(eMc, setup, width_m);
}

std::vector<std::vector<Eigen::Vector2d>> model_lines(const Pose& eMc, const CameraSetup& setup,
                                                      std::optional<double> width_m) {
  const double half_width_m = 0.5 * width_m.value_or(rules::min_width_m);
  std::vector<std::vector<Eigen::Vector2d>> curves;
  for (const double radius : rules::ring_radii_m) {
    curves.emplace_back();
    for (double a = 0.0; a < 6.3; a += 0.02) curves.back().emplace_back(radius * std::cos(a), radius * std::sin(a));
  }
  for (const CrossLine& line : cross_lines()) {
    curves.push_back(stretch({-half_width_m, line.centre_y_m()}, {half_width_m, line.centre_y_m()}));
  }
  curves.push_back(stretch({0.0, centre_line_begin_y_m}, {0.0, centre_line_end_y_m}));
  if (width_m) {
    for (const double x : {-half_width_m, half_width_m}) {
      curves.push_back(stretch({x, centre_line_begin_y_m}, {x, centre_line_end_y_m}));
    }
  }
  const SheetCamera camera(Lens(setup.intrinsics), eMc, setup.ice);
  std::vector<PolyLine> lines;
  for (const auto& curve : curves) add_visible(curve, camera, lines);
  return lines;
}

}  // namespace hogline::vision
