#include "vision/fit/stone_region.hpp"

#include <gtest/gtest.h>

#include <array>
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
SightLines sight(const SheetCamera& camera, const Eigen::Vector2d& pixel) {
  const auto slope = [&camera](const Eigen::Vector2d& p) -> Eigen::Vector2d {
    const Eigen::Vector3d d = camera.eMc().linear() * *camera.lens().ray(p);
    return d.head<2>() / -d.z();
  };
  const Eigen::Vector2d at = slope(pixel);
  const Eigen::Vector2d column(0.5, 0.0);
  const Eigen::Vector2d row(0.0, 0.5);
  const Eigen::Vector2d by_column = slope(pixel + column) - slope(pixel - column);
  const Eigen::Vector2d by_row = slope(pixel + row) - slope(pixel - row);
  SightLines s;
  s.resize(1);
  s.x[0] = static_cast<float>(at.x());
  s.y[0] = static_cast<float>(at.y());
  s.x_by_column[0] = static_cast<float>(by_column.x());
  s.y_by_column[0] = static_cast<float>(by_column.y());
  s.x_by_row[0] = static_cast<float>(by_row.x());
  s.y_by_row[0] = static_cast<float>(by_row.y());
  return s;
}

/// One pixel's distance, its direction, and its derivatives: place, thickness, body's radius and half height, handle's
/// height and radius.
struct At {
  double px;
  Eigen::Vector2d outward;
  std::array<double, 7> by;
};

using Distance = At (*)(const StonePlace&, const Eigen::Vector3d&, const SightLines&);

At of(const DiscDistances& d) {
  const auto n = [](const Pixels& p) { return static_cast<double>(p[0]); };
  return {n(d.px),
          {n(d.outward_x), n(d.outward_y)},
          {n(d.by_x), n(d.by_y), -n(d.part) * n(d.by_height), 0.0, 0.0, n(d.by_height), n(d.by_radius)}};
}

At handle_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& s) {
  DiscDistances d;
  handle_distances(stone, eye, s, d);
  return of(d);
}

At face_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& s) {
  DiscDistances d;
  face_distances(stone, eye, s, d);
  return of(d);
}

At body_distance(const StonePlace& stone, const Eigen::Vector3d& eye, const SightLines& s) {
  BodyDistances d;
  body_distances(stone, eye, s, d);
  const auto n = [](const Pixels& p) { return static_cast<double>(p[0]); };
  return {n(d.px),
          {n(d.outward_x), n(d.outward_y)},
          {n(d.by_x), n(d.by_y), 0.0, n(d.by_radius), n(d.by_half_height), 0.0, 0.0}};
}

struct Case {
  const char* what;
  double x_m, y_m;
};
const Case cases[] = {{"near", 0.4, -1.6}, {"in the house", -0.7, 0.6}, {"before the hog line", 1.4, 6.1}};

TEST(StoneRegion, DistancesAloneAreTheSame) {
  const SheetCamera c = camera();
  const Eigen::Vector3d eye = c.eMc().translation();
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    const StonePlace stone{{one.x_m, one.y_m}, {}};
    const auto pixel = c.project({one.x_m, one.y_m, 0.1});
    ASSERT_TRUE(pixel);
    const SightLines s = sight(c, *pixel);
    Pixels px;
    handle_px(stone, eye, s, px);
    EXPECT_EQ(static_cast<double>(px[0]), handle_distance(stone, eye, s).px);
    body_px(stone, eye, s, px);
    EXPECT_EQ(static_cast<double>(px[0]), body_distance(stone, eye, s).px);
  }
}

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
      const At at = body_distance(stone, eye, sight(c, *body));
      EXPECT_NEAR(at.outward.norm(), 1.0, 1e-5);
      EXPECT_NEAR(body_distance(stone, eye, sight(c, *body + at.outward)).px, -1.0, 0.07) << a;
      EXPECT_NEAR(body_distance(stone, eye, sight(c, *body - at.outward)).px, 1.0, 0.07) << a;
    }
  }
}

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
        const SightLines s = sight(c, *pixel);
        const At at = distance(stone, eye, s);
        for (int i = 0; i < 7; ++i) {
          StonePlace more = stone;
          StonePlace less = stone;
          constexpr double step_m = 1e-3;
          *number_of(more, i) += step_m;
          *number_of(less, i) -= step_m;
          const double slope = (distance(more, eye, s).px - distance(less, eye, s).px) / (2.0 * step_m);
          EXPECT_NEAR(at.by[static_cast<std::size_t>(i)], slope, 0.03 * std::abs(slope) + 3.0)
              << name << " " << one.what << " a " << a << " i " << i;
        }
      }
    }
  }
}

// A rounded edge is seen below the corner that it rounds; how far follows from the touching line alone.
TEST(StoneRegion, ARoundedRimIsSeenLower) {
  StoneShape shape;
  EXPECT_EQ(rim_lowering_m(shape, 5.0, 2.0), 0.0) << "sharp";
  shape.rim_rounding_m = 0.003;
  const auto lowering = [&shape](double elevation_deg) {
    const double range_m = 5.0;
    return rim_lowering_m(shape, range_m, shape.handle_height_m + range_m * std::tan(elevation_deg * degree));
  };
  EXPECT_NEAR(lowering(10.0), 0.00048, 1e-5);
  EXPECT_NEAR(lowering(40.0), 0.00160, 1e-5);
  EXPECT_GT(lowering(40.0), lowering(10.0));
}

}  // namespace
}  // namespace hogline::vision
