#include "vision/geometry/sheet_camera.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include "tests/vision/geometry/numerical_derivative.hpp"

namespace hogline::vision {
namespace {

using testing::numerical_derivative;

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

const Intrinsics near_lens{
    1600, 1200, LensModel::brown_conrady, 780.0, 780.0, 803.2, 596.4, {-0.12, 0.015, 0.0003, -0.0002, 0.0}};
const Intrinsics fish_eye{1600,  1200,  LensModel::kannala_brandt,         560.0, 560.0,
                          803.2, 596.4, {-0.02, 0.006, -0.004, 0.001, 0.0}};

SheetCamera a_camera() {
  const bool fish = *rc::gen::arbitrary<bool>();
  const Mount mount{0.2, 0.0, fish ? 0.5 : 2.0, uniform(-0.02, 0.02), uniform(0.2, 0.6), uniform(-0.02, 0.02)};
  const PlanarPose body{uniform(-1.2, 1.2), uniform(-5.5, -1.5), uniform(-0.26, 0.26)};
  return SheetCamera(Lens(fish ? fish_eye : near_lens), eMb(body) * bMc(mount), {uniform(0.003, 0.012), 1.309});
}

RC_GTEST_PROP(SheetCamera, PaintComesBackFromItsPixel, ()) {
  const SheetCamera camera = a_camera();
  const Eigen::Vector2d paint(uniform(-2.5, 2.5), uniform(-2, 8));
  const auto pixel = camera.project_paint(paint);
  if (!pixel) return;
  const auto again = camera.paint_at(*pixel);
  RC_ASSERT(again.has_value());
  RC_ASSERT((*again - paint).norm() < 1e-8);
}

RC_GTEST_PROP(SheetCamera, APointInTheAirComesBackFromItsPixel, ()) {
  const SheetCamera camera = a_camera();
  const Eigen::Vector3d plate(uniform(-2.5, 2.5), uniform(-1, 8), 0.125);
  const auto pixel = camera.project(plate);
  if (!pixel) return;
  const auto again = camera.plane_at(*pixel, plate.z());
  RC_ASSERT(again.has_value());
  RC_ASSERT((*again - plate.head<2>()).norm() < 1e-8);
}

RC_GTEST_PROP(SheetCamera, DerivativesMatchFiniteDifferences, ()) {
  const SheetCamera camera = a_camera();
  const Eigen::Vector2d paint(uniform(-2.5, 2.5), uniform(-1, 8));
  const auto projected = camera.project_paint_with_jacobian(paint);
  if (!projected || !camera.lens().in_picture(projected->pixel)) return;

  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const auto by_pose = numerical_derivative<2, 6>(
      [&](const Vector6& xi) {
        SheetCamera moved = camera;
        moved.move_to(camera.eMc() * exp({xi.head<3>(), xi.tail<3>()}));
        return *moved.project_paint(paint);
      },
      Vector6::Zero().eval(), 1e-6);
  const auto by_paint =
      numerical_derivative<2, 2>([&](const Eigen::Vector2d& p) { return *camera.project_paint(p); }, paint, 1e-6);
  const auto by_depth = numerical_derivative<2, 1>(
      [&](const Eigen::Matrix<double, 1, 1>& d) {
        return *SheetCamera(camera.lens(), camera.eMc(), {d(0), camera.ice().refractive_index}).project_paint(paint);
      },
      Eigen::Matrix<double, 1, 1>(camera.ice().paint_depth_m), 1e-6);
  RC_ASSERT((by_pose - projected->by_pose).norm() < 1e-5 * (1.0 + by_pose.norm()));
  RC_ASSERT((by_paint - projected->by_paint).norm() < 1e-5 * (1.0 + by_paint.norm()));
  RC_ASSERT((by_depth - projected->by_depth).norm() < 1e-4 * (1.0 + by_depth.norm()));
  RC_ASSERT((*camera.project_paint(paint) - projected->pixel).norm() < 1e-12);
}

TEST(SheetCamera, NothingIsSeenAboveTheHorizon) {
  const SheetCamera camera(Lens(near_lens), eMb({0.0, -3.0, 0.0}) * bMc({0.2, 0.0, 2.0, 0.0, 0.5, 0.0}),
                           {0.006, 1.309});
  EXPECT_FALSE(camera.paint_at({803.0, 10.0}));
  EXPECT_TRUE(camera.paint_at({803.0, 900.0}));
  EXPECT_FALSE(camera.plane_at({803.0, 900.0}, 2.5)) << "a plane above the camera";
}

}  // namespace
}  // namespace hogline::vision
