#include "vision/near_view_sketch.hpp"

#include "vision/fit/painted_features.hpp"
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
  const SheetCamera camera(Lens(setup.intrinsics), eMc, setup.ice);
  std::vector<PaintedFeature> features = fixed_features();
  if (width_m) {
    features.push_back(sideline(PaintedFeature::Place::left_sideline, *width_m));
    features.push_back(sideline(PaintedFeature::Place::right_sideline, *width_m));
  }
  std::vector<PolyLine> lines;
  for (const PaintedFeature& f : features) {
    const double step = f.shape == PaintedFeature::Shape::circle ? 0.02 : 0.05;
    PolyLine line;
    for (double p = f.begin_m; p <= f.end_m + step; p += step) {
      const auto pixel = camera.project_paint(point_on(f, p).at);
      if (pixel && camera.lens().in_picture(*pixel)) {
        line.push_back(*pixel);
      } else if (!line.empty()) {
        lines.push_back(std::move(line));
        line = {};
      }
    }
    if (line.size() > 1) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace hogline::vision
