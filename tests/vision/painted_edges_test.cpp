// The geometry against pictures: paint projected with the true pose falls on the painted edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/vision/scene.hpp"
#include "vision/geometry/response_curve.hpp"
#include "vision/geometry/sheet.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::vision {
namespace {

using testing::load_scene;
using testing::Scene;

struct Stroke {
  Eigen::Vector2d centre;
  Eigen::Vector2d normal;
  double px_per_m;
};

std::optional<Stroke> stroke(const SheetCamera& camera, const Eigen::Vector2d& paint, const Eigen::Vector2d& across) {
  const auto p = camera.project_paint_with_jacobian(paint);
  if (!p || !camera.lens().in_picture(p->pixel, 20.0)) return std::nullopt;
  // The edge's tangent in the picture gives the normal; `across` only its sense.
  const Eigen::Vector2d tangent = (p->by_paint * Eigen::Vector2d(-across.y(), across.x())).normalized();
  Eigen::Vector2d normal(-tangent.y(), tangent.x());
  const double scale = normal.dot(p->by_paint * across);
  if (scale < 0.0) normal = -normal;
  return Stroke{p->pixel, normal, std::abs(scale)};
}

// Linear light of all channels along a stroke, every half pixel from -half_px to half_px.
constexpr double step_px = 0.5;
std::vector<Eigen::Vector3d> profile(const Scene& scene, const Stroke& s, double half_px) {
  const ResponseCurve response(scene.setup.gamma);
  const auto at = [&](int x, int y) {
    const auto& p = scene.image.at<cv::Vec3b>(y, x);
    return Eigen::Vector3d(static_cast<double>(response.linear(p[0])), static_cast<double>(response.linear(p[1])),
                           static_cast<double>(response.linear(p[2])));
  };
  std::vector<Eigen::Vector3d> light;
  for (double t = -half_px; t <= half_px; t += step_px) {
    const Eigen::Vector2d p = s.centre + t * s.normal;
    const int x = static_cast<int>(p.x());
    const int y = static_cast<int>(p.y());
    const double u = p.x() - x;
    const double v = p.y() - y;
    light.push_back((1.0 - v) * ((1.0 - u) * at(x, y) + u * at(x + 1, y)) +
                    v * ((1.0 - u) * at(x, y + 1) + u * at(x + 1, y + 1)));
  }
  return light;
}

Eigen::Vector3d mean(const std::vector<Eigen::Vector3d>& light, std::size_t begin, std::size_t end) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = begin; i < end; ++i) sum += light[i];
  return sum / static_cast<double>(end - begin);
}

// Where a blurred step lies, whatever its blur: the area under it between its two levels.
std::optional<double> step_offset(const std::vector<Eigen::Vector3d>& light, double half_px) {
  const std::size_t flank = light.size() / 5;
  const Eigen::Vector3d before = mean(light, 0, flank);
  const Eigen::Vector3d change = mean(light, light.size() - flank, light.size()) - before;
  if (change.norm() < 0.1) return std::nullopt;
  double area = 0.0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double weight = i == 0 || i + 1 == light.size() ? 0.5 : 1.0;
    area += weight * step_px * (light[i] - before).dot(change) / change.squaredNorm();
  }
  return half_px - area;
}

// Where a line darker than what is beside it lies: its centroid.
std::optional<double> line_offset(const std::vector<Eigen::Vector3d>& light, double half_px) {
  const std::size_t flank = light.size() / 5;
  const Eigen::Vector3d side = 0.5 * (mean(light, 0, flank) + mean(light, light.size() - flank, light.size()));
  double mass = 0.0;
  double moment = 0.0;
  for (std::size_t i = flank; i + flank < light.size(); ++i) {
    const double dark = (side - light[i]).sum();
    mass += dark;
    moment += dark * (static_cast<double>(i) * step_px - half_px);
  }
  if (mass * step_px < 0.3 * side.sum()) return std::nullopt;
  return moment / mass;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

class PaintedEdges : public ::testing::TestWithParam<const char*> {};

TEST_P(PaintedEdges, RingsFallOnTheirProjection) {
  constexpr double half_px = 8.0;
  const Scene scene = load_scene(GetParam());
  const SheetCamera camera(Lens(scene.setup.intrinsics), scene.eMc, scene.setup.ice);
  for (const double radius_m : {rules::outer_ring_radius_m, rules::middle_ring_radius_m, rules::inner_ring_radius_m}) {
    std::vector<double> offsets;
    for (int i = 0; i < 360; ++i) {
      const double angle = (i + 0.5) * std::numbers::pi / 180.0;
      const Eigen::Vector2d outwards(std::cos(angle), std::sin(angle));
      const auto s = stroke(camera, radius_m * outwards, outwards);
      const auto offset = s ? step_offset(profile(scene, *s, half_px), half_px) : std::nullopt;
      if (offset) offsets.push_back(*offset);
    }
    ASSERT_GT(offsets.size(), 120U) << "radius " << radius_m;
    EXPECT_NEAR(median(offsets), 0.0, 0.15) << "radius " << radius_m;
  }
}

TEST_P(PaintedEdges, HogLinesMiddleFallsOnItsProjection) {
  constexpr double half_px = 5.0;
  const Scene scene = load_scene(GetParam());
  const SheetCamera camera(Lens(scene.setup.intrinsics), scene.eMc, scene.setup.ice);
  std::vector<double> offsets;
  for (double x = -2.0; x <= 2.0; x += 0.02) {
    const auto s = stroke(camera, {x, cross_line("hog_line").centre_y_m()}, Eigen::Vector2d::UnitY());
    const auto offset = s ? line_offset(profile(scene, *s, half_px), half_px) : std::nullopt;
    if (offset) offsets.push_back(*offset);
  }
  ASSERT_GT(offsets.size(), 60U);
  EXPECT_NEAR(median(offsets), 0.0, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PaintedEdges,
                         ::testing::Values("near/near-11-000", "near/near-11-003", "near/near-11-009",
                                           "skip/skip-12-002"));

}  // namespace
}  // namespace hogline::vision
