#include "vision/geometry/lens.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>
#include <limits>

#include "tests/vision/geometry/numerical_derivative.hpp"

namespace hogline::vision {
namespace {

using testing::numerical_derivative;

struct Case {
  const char* description;
  Intrinsics intrinsics;
};

Intrinsics brown(std::array<double, 5> d, double f = 780.0) {
  return {1600, 1200, LensModel::brown_conrady, f, 1.01 * f, 803.2, 596.4, d};
}
Intrinsics kannala(std::array<double, 5> d, double f = 500.0) {
  return {1600, 1200, LensModel::kannala_brandt, f, 0.99 * f, 803.2, 596.4, d};
}

const Case& a_case() {
  static const Case cases[] = {
      {"no distortion", brown({})},
      {"near view", brown({-0.12, 0.015, 0.0003, -0.0002, 0.0})},
      {"folds back inside the picture", brown({-0.35, 0.0, 0.0003, -0.0002, 0.0}, 600.0)},
      {"pincushion with all terms", brown({0.08, -0.01, -0.001, 0.002, 0.003})},
      {"barrel with k3 that turns it round", brown({-0.25, 0.08, 0.0, 0.0, -0.02}, 600.0)},
      {"equidistant", kannala({})},
      {"fish-eye", kannala({-0.02, 0.006, -0.004, 0.001, 0.0})},
      {"fish-eye that folds back", kannala({-0.2, 0.0, 0.0, 0.0, 0.0})},
  };
  return cases[*rc::gen::inRange<std::size_t>(0, std::size(cases))];
}

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

RC_GTEST_PROP(Lens, EveryPixelWithARayComesBackToItself, ()) {
  const Case& c = a_case();
  const Lens lens(c.intrinsics);
  const Eigen::Vector2d pixel(uniform(-200, 1800), uniform(-200, 1400));
  const auto ray = lens.ray(pixel);
  if (!ray) return;
  const auto again = lens.project(*ray);
  RC_ASSERT(again.has_value());
  RC_ASSERT((*again - pixel).norm() < 1e-9);
}

RC_GTEST_PROP(Lens, EveryPointWithAPixelLiesOnThatPixelsRay, ()) {
  const Case& c = a_case();
  const Lens lens(c.intrinsics);
  const Eigen::Vector3d point(uniform(-3, 3), uniform(-3, 3), uniform(-0.2, 2));
  const auto pixel = lens.project(point);
  if (!pixel || pixel->norm() > 5000.0) return;  // most of these points lie beside what the lens shows
  const auto ray = lens.ray(*pixel);
  RC_ASSERT(ray.has_value());
  const auto again = lens.project(*ray);
  RC_ASSERT(again.has_value());
  RC_ASSERT((*again - *pixel).norm() < 1e-9);
}

RC_GTEST_PROP(Lens, ProjectionOnlyDependsOnDirection, ()) {
  const Lens lens(a_case().intrinsics);
  const Eigen::Vector3d point(uniform(-1, 1), uniform(-1, 1), uniform(0.5, 2));
  const auto a = lens.project(point);
  const auto b = lens.project(7.0 * point);
  RC_ASSERT(a.has_value() == b.has_value());
  RC_ASSERT(!a || (*a - *b).norm() < 1e-9);
}

RC_GTEST_PROP(Lens, JacobianMatchesFiniteDifferences, ()) {
  const Lens lens(a_case().intrinsics);
  const Eigen::Vector3d point(uniform(-1, 1), uniform(-1, 1), uniform(0.8, 2));
  Lens::Jacobian jacobian;
  const auto visible = [&](const Eigen::Vector3d& p) { return lens.project(p, &jacobian).has_value(); };
  for (int i = 0; i < 3; ++i) {
    if (!visible(point + 1e-5 * Eigen::Vector3d::Unit(i)) || !visible(point - 1e-5 * Eigen::Vector3d::Unit(i))) return;
  }
  if (!visible(point)) return;
  const auto numerical = numerical_derivative<2, 3>([&](const Eigen::Vector3d& p) { return *lens.project(p); }, point);
  RC_ASSERT((numerical - jacobian).norm() < 1e-5 * (1.0 + jacobian.norm()));
}

TEST(Lens, NothingBehindTheFoldOrTheCamera) {
  const Lens folding(brown({-0.35, 0.0, 0.0, 0.0, 0.0}, 600.0));
  const double fold = 1.0 / std::sqrt(3.0 * 0.35);  // where r (1 - 0.35 r^2) stops growing
  EXPECT_TRUE(folding.project({0.98 * fold, 0.0, 1.0}));
  EXPECT_FALSE(folding.project({1.02 * fold, 0.0, 1.0}));
  EXPECT_FALSE(folding.project({0.1, 0.0, -1.0}));
  EXPECT_FALSE(folding.ray({803.2 + 600.0 * fold, 596.4})) << "further out than the fold's image";
  const Lens fisheye(kannala({}));
  EXPECT_TRUE(fisheye.project({1.0, 0.0, -0.1})) << "a fish-eye sees a little backwards";
  EXPECT_FALSE(fisheye.project({0.0, 0.0, -1.0}));
}

TEST(Lens, AxisAndBadInput) {
  for (const Lens& lens : {Lens(brown({-0.12, 0.015, 0.0003, -0.0002, 0.0})), Lens(kannala({}))}) {
    const Eigen::Vector2d centre(803.2, 596.4);
    Lens::Jacobian jacobian;
    EXPECT_NEAR((*lens.project({0, 0, 2}, &jacobian) - centre).norm(), 0.0, 1e-12);
    EXPECT_TRUE(jacobian.allFinite());
    EXPECT_NEAR((lens.ray(centre)->normalized() - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(lens.ray({nan, 1.0}));
    EXPECT_FALSE(lens.project({nan, 1.0, 1.0}));
    EXPECT_FALSE(lens.project({0.0, 0.0, 0.0}));
  }
}

TEST(Lens, InPictureCountsPixelCentres) {
  const Lens lens(brown({}));
  EXPECT_TRUE(lens.in_picture({0.0, 0.0}));
  EXPECT_TRUE(lens.in_picture({1599.0, 1199.0}));
  EXPECT_FALSE(lens.in_picture({1599.1, 10.0}));
  EXPECT_FALSE(lens.in_picture({1.0, 10.0}, 2.0));
}

}  // namespace
}  // namespace hogline::vision
