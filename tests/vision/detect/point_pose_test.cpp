#include "vision/detect/point_pose.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <Eigen/LU>
#include <limits>

#include "tests/vision/detect/sheet_view.hpp"

namespace hogline::vision {
namespace {

using testing::SheetView;

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

FourPoints exact_points(const SheetView& sheet) {
  const double R = rules::outer_ring_radius_m;
  FourPoints four{{}, {{{R, 0.0}, {-R, 0.0}, {0.0, R}, {0.0, -R}}}};
  for (std::size_t i = 0; i < 4; ++i) four.plane[i] = sheet.plane(four.sheet[i].x(), four.sheet[i].y());
  return four;
}

RC_GTEST_PROP(PointPose, RefinedPoseOfExactPointsIsTheTrueOne, ()) {
  const SheetView sheet({uniform(-1.2, 1.2), uniform(-5.5, -2.0), uniform(-0.26, 0.26)});
  const FourPoints four = exact_points(sheet);
  const auto start = epnp(four);
  RC_ASSERT(start.has_value());
  const auto refined = refine_pose(four, start->eMc);
  RC_ASSERT(refined.has_value());
  RC_ASSERT(refined->reprojection < 1e-6);
  RC_ASSERT((refined->eMc.translation() - sheet.eMc.translation()).norm() < 1e-3);
}

// Half a pixel of noise on each point: virtual servoing never ends with more error than it began with.
RC_GTEST_PROP(PointPose, RefinementDoesNotMakeTheErrorLarger, ()) {
  const SheetView sheet({uniform(-1.2, 1.2), uniform(-5.5, -2.0), uniform(-0.26, 0.26)});
  FourPoints four = exact_points(sheet);
  for (auto& p : four.plane) p += Eigen::Vector2d(uniform(-0.5, 0.5), uniform(-0.5, 0.5)) / 780.0;
  const auto start = epnp(four);
  if (!start) return;
  const auto refined = refine_pose(four, start->eMc);
  if (!refined) return;
  RC_ASSERT(refined->reprojection <= start->reprojection + 1e-9);
}

TEST(PointPose, NothingForPointsThatDetermineNoPose) {
  FourPoints four = exact_points(SheetView({0.0, -3.5, 0.0}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  FourPoints broken = four;
  broken.plane[2] << nan, nan;
  std::optional<PointPose> pose;
  ASSERT_NO_THROW(pose = epnp(broken));
  EXPECT_FALSE(pose);
  ASSERT_NO_THROW(pose = refine_pose(broken, SheetView({0.0, -3.5, 0.0}).eMc));
  EXPECT_FALSE(pose);
}

}  // namespace
}  // namespace hogline::vision
