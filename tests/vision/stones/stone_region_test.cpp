#include "vision/fit/stone_region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hogline::vision {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

SheetCamera camera() {
  const Intrinsics k{
      1600, 1200, LensModel::brown_conrady, 780.0, 780.0, 803.2, 596.4, {-0.12, 0.015, 0.0003, -0.0002, 0.0}};
  const Pose eMc = eMb({0.2, -4.0, 3.0 * degree}) * bMc({0.2, 0.0, 2.0, 0.0, 28.0 * degree, 0.0});
  return {Lens(k), eMc, Ice{0.006, 1.309}};
}

// Of a pixel, by differences of the lens's own rays.
SightLine sight(const SheetCamera& camera, const Eigen::Vector2d& pixel) {
  const auto slope = [&camera](const Eigen::Vector2d& p) -> Eigen::Vector2d {
    const Eigen::Vector3d d = camera.eMc().linear() * *camera.lens().ray(p);
    return d.head<2>() / -d.z();
  };
  SightLine s;
  s.slope = slope(pixel);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = 0.5 * Eigen::Vector2d::Unit(i);
    s.by_pixel.col(i) = slope(pixel + step) - slope(pixel - step);
  }
  return s;
}

struct Case {
  const char* what;
  double x_m, y_m;
};
const Case cases[] = {{"near", 0.4, -1.6}, {"in the house", -0.7, 0.6}, {"before the hog line", 1.4, 6.1}};

TEST(StoneRegion, ThePixelsOfAnOutlineAreAtDistanceZero) {
  const SheetCamera c = camera();
  const Eigen::Vector3d eye = c.eMc().translation();
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    const StonePlace stone{{one.x_m, one.y_m}, {}};
    const Bearing bearing = bearing_of(stone.place, eye);
    for (double a = 0.1; a < 6.2; a += 0.4) {
      const auto body = c.project(body_outline_point(stone.place, stone.shape, eye, a));
      ASSERT_TRUE(body);
      EXPECT_NEAR(body_distance(stone, eye, sight(c, *body)).px, 0.0, 0.01) << a;
      const auto rim =
          c.project(circle_point(stone.place, bearing, stone.shape.handle_radius_m, stone.shape.handle_height_m, a));
      ASSERT_TRUE(rim);
      EXPECT_NEAR(face_distance(stone, eye, sight(c, *rim)).px, 0.0, 0.01) << a;
    }
  }
}

TEST(StoneRegion, DistancesAreInPixels) {
  const SheetCamera c = camera();
  const Eigen::Vector3d eye = c.eMc().translation();
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    const StonePlace stone{{one.x_m, one.y_m}, {}};
    for (double a = 0.1; a < 6.2; a += 0.4) {
      const auto body = c.project(body_outline_point(stone.place, stone.shape, eye, a));
      const RegionDistance at = body_distance(stone, eye, sight(c, *body));
      EXPECT_NEAR(at.outward.norm(), 1.0, 1e-6);
      EXPECT_NEAR(body_distance(stone, eye, sight(c, *body + at.outward)).px, -1.0, 0.07) << a;
      EXPECT_NEAR(body_distance(stone, eye, sight(c, *body - at.outward)).px, 1.0, 0.07) << a;
    }
  }
}

using Distance = RegionDistance (*)(const StonePlace&, const Eigen::Vector3d&, const SightLine&);

double* number_of(StonePlace& stone, int i) {
  switch (i) {
    case 0:
      return &stone.place.x();
    case 1:
      return &stone.place.y();
    case 2:
      return &stone.shape.handle_thickness_m;
    case 3:
      return &stone.shape.body_radius_m;
    case 4:
      return &stone.shape.body_half_height_m;
    case 5:
      return &stone.shape.handle_height_m;
    default:
      return &stone.shape.handle_radius_m;
  }
}

// On the outline, where a distance's scale does not count.
TEST(StoneRegion, DerivativesAreThoseOfFiniteDifferences) {
  const SheetCamera c = camera();
  const Eigen::Vector3d eye = c.eMc().translation();
  const std::pair<const char*, Distance> regions[] = {
      {"handle", handle_distance}, {"face", face_distance}, {"body", body_distance}};
  for (const auto& [name, distance] : regions) {
    for (const Case& one : cases) {
      const StonePlace stone{{one.x_m, one.y_m}, {}};
      const Bearing bearing = bearing_of(stone.place, eye);
      for (const double a : {0.5, 1.4, 2.9, 4.2, 5.5}) {
        const auto pixel =
            distance == body_distance
                ? c.project(body_outline_point(stone.place, stone.shape, eye, a))
                : c.project(circle_point(
                      stone.place, bearing, stone.shape.handle_radius_m,
                      stone.shape.handle_height_m - (distance == handle_distance && a > 3.2 ? 0.015 : 0.0), a));
        const SightLine s = sight(c, *pixel);
        const RegionDistance at = distance(stone, eye, s);
        for (int i = 0; i < 7; ++i) {
          StonePlace more = stone;
          StonePlace less = stone;
          constexpr double step_m = 1e-5;
          *number_of(more, i) += step_m;
          *number_of(less, i) -= step_m;
          const double slope = (distance(more, eye, s).px - distance(less, eye, s).px) / (2.0 * step_m);
          EXPECT_NEAR(at.by[i], slope, 0.02 * std::abs(slope) + 1.0)
              << name << " " << one.what << " a " << a << " i " << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace hogline::vision
