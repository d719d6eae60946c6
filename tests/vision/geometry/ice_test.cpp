#include "vision/geometry/ice.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>

#include "tests/vision/geometry/numerical_derivative.hpp"

namespace hogline::vision {
namespace {

using testing::numerical_derivative;

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

RC_GTEST_PROP(Ice, PaintUnderIsTheInverseOfSurfacePoint, ()) {
  const Eigen::Vector3d camera(uniform(-2, 2), uniform(-2, 2), uniform(0.2, 2.5));
  const Eigen::Vector2d paint(uniform(-30, 30), uniform(-30, 30));
  const Ice ice{uniform(0.0, 0.02), uniform(1.0, 1.5)};
  const SurfacePoint s = surface_point(paint, camera, ice);
  RC_ASSERT((paint_under(s.xy, camera, ice) - paint).norm() < 1e-11);
}

RC_GTEST_PROP(Ice, ObeysSnell, ()) {
  const Eigen::Vector3d camera(0, 0, uniform(0.2, 2.5));
  const Eigen::Vector2d paint(uniform(0.1, 30), 0);
  const Ice ice{uniform(0.001, 0.02), 1.309};
  const double r = surface_point(paint, camera, ice).xy.x();
  const double sine_air = r / std::hypot(r, camera.z());
  const double sine_ice = (paint.x() - r) / std::hypot(paint.x() - r, ice.paint_depth_m);
  RC_ASSERT(std::abs(sine_air - ice.refractive_index * sine_ice) < 1e-9);
}

RC_GTEST_PROP(Ice, DerivativesMatchFiniteDifferences, ()) {
  const Eigen::Vector3d camera(uniform(-2, 2), uniform(-2, 2), uniform(0.4, 2.5));
  const Eigen::Vector2d paint(uniform(3, 12), uniform(3, 12));
  const Ice ice{uniform(0.002, 0.02), 1.309};
  const SurfacePoint s = surface_point(paint, camera, ice);
  const auto by_paint =
      numerical_derivative<2, 2>([&](const Eigen::Vector2d& p) { return surface_point(p, camera, ice).xy; }, paint);
  const auto by_camera =
      numerical_derivative<2, 3>([&](const Eigen::Vector3d& c) { return surface_point(paint, c, ice).xy; }, camera);
  const auto by_depth = numerical_derivative<2, 1>(
      [&](const Eigen::Matrix<double, 1, 1>& d) {
        return surface_point(paint, camera, {d(0), ice.refractive_index}).xy;
      },
      Eigen::Matrix<double, 1, 1>(ice.paint_depth_m));
  RC_ASSERT((by_paint - s.by_paint).norm() < 1e-7);
  RC_ASSERT((by_camera - s.by_camera).norm() < 1e-7);
  RC_ASSERT((by_depth - s.by_depth).norm() < 1e-6);
}

TEST(Ice, DerivativesAreContinuousStraightBelowTheCamera) {
  const Ice ice{0.008, 1.309};
  const Eigen::Vector3d camera(1.0, 2.0, 0.5);
  const SurfacePoint below = surface_point({1.0, 2.0}, camera, ice);
  const SurfacePoint beside = surface_point({1.0 + 1e-6, 2.0}, camera, ice);
  EXPECT_LT((below.by_paint - beside.by_paint).norm(), 1e-6);
  EXPECT_LT((below.by_camera - beside.by_camera).norm(), 1e-5);
}

// The light leaves the ice further out than if it went straight on from the paint to the camera: by this much, on the
// surface, a camera that knows the paint's depth but not its refraction is wrong.
TEST(Ice, RefractionShiftsPaintByWhatWasMeasured) {
  struct Case {
    const char* description;
    double height_m, distance_m, shift_m;
  };
  const Case cases[] = {{"near view, 8 m away", 2.0, 8.0, 0.023}, {"low view, 3 m away", 0.5, 3.0, 0.039}};
  for (const Case& c : cases) {
    const Ice ice{0.008, 1.309};
    const double r = surface_point({c.distance_m, 0.0}, {0.0, 0.0, c.height_m}, ice).xy.x();
    const double straight = c.distance_m * c.height_m / (c.height_m + ice.paint_depth_m);
    EXPECT_NEAR(r - straight, c.shift_m, 0.0015) << c.description;
  }
}

}  // namespace
}  // namespace hogline::vision
