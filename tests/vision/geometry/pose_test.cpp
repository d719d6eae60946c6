#include "vision/geometry/pose.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <numbers>

namespace hogline::vision {
namespace {

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

Twist a_twist(double turn) {
  return {{uniform(-5, 5), uniform(-5, 5), uniform(-5, 5)},
          {uniform(-turn, turn), uniform(-turn, turn), uniform(-turn, turn)}};
}

RC_GTEST_PROP(Pose, LogIsTheInverseOfExp, ()) {
  const double scale = *rc::gen::element(1.0, 0.05, 0.01, 0.001, 1e-5, 1e-8);
  const Twist twist = a_twist(1.7 * scale);
  const Twist again = log(exp(twist));
  RC_ASSERT((again.linear - twist.linear).norm() < 1e-9);
  RC_ASSERT((again.angular - twist.angular).norm() < 1e-9);
}

RC_GTEST_PROP(Pose, ComposedWithItsInverseIsNothing, ()) {
  const Pose pose = exp(a_twist(1.7));
  RC_ASSERT((pose * pose.inverse()).isApprox(Pose::Identity(), 1e-12));
}

RC_GTEST_PROP(Pose, HalfATwistTwiceIsTheTwist, ()) {
  const Twist twist = a_twist(1.0 * *rc::gen::element(1.0, 0.02, 0.009, 1e-4));
  const Pose half = exp({0.5 * twist.linear, 0.5 * twist.angular});
  RC_ASSERT((half * half).matrix().isApprox(exp(twist).matrix(), 1e-12));
}

RC_GTEST_PROP(Pose, RowsComeBack, ()) {
  const Pose pose = exp(a_twist(1.5));
  RC_ASSERT(from_row_major(row_major(pose)).matrix() == pose.matrix());
}

RC_GTEST_PROP(Pose, PlanarBodyIsTheBodyThatCarriesTheCamera, ()) {
  const Mount mount{uniform(-1, 1), uniform(-1, 1), uniform(0.3, 2), uniform(-0.1, 0.1), uniform(0, 1), uniform(-3, 3)};
  const PlanarPose body{uniform(-2, 2), uniform(-8, 8), uniform(-3, 3)};
  const PlanarPose again = planar_body(eMb(body) * bMc(mount), mount);
  RC_ASSERT(std::abs(again.x_m - body.x_m) < 1e-12);
  RC_ASSERT(std::abs(again.y_m - body.y_m) < 1e-12);
  RC_ASSERT(std::abs(wrapped(again.yaw_rad - body.yaw_rad)) < 1e-12);
}

RC_GTEST_PROP(Pose, ARockingBodyDoesNotMoveThePlanarBody, ()) {
  const Mount mount{0.2, 0.05, 2.0, 0.0, 0.5, 0.0};
  Mount rocked = mount;
  rocked.pitch_rad += uniform(-0.01, 0.01);
  const PlanarPose body{uniform(-1, 1), uniform(-5, -2), uniform(-0.2, 0.2)};
  const PlanarPose again = planar_body(eMb(body) * bMc(rocked), mount);
  RC_ASSERT(std::abs(again.x_m - body.x_m) < 1e-12);
  RC_ASSERT(std::abs(again.y_m - body.y_m) < 1e-12);
  RC_ASSERT(std::abs(again.yaw_rad - body.yaw_rad) < 1e-12);
}

TEST(Pose, FramesAreNamedAsTheNotationSays) {
  const Pose level = bMc({0.2, 0.0, 2.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE((level.linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX())) << "c looks forward";
  EXPECT_TRUE((level.linear() * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY())) << "c's x is right";
  const Pose down = bMc({0.2, 0.0, 2.0, 0.0, 0.5, 0.0});
  EXPECT_LT((down.linear() * Eigen::Vector3d::UnitZ()).z(), 0.0) << "pitch > 0 looks down";
  const Pose body = eMb({1.0, -3.0, 0.1});
  const Eigen::Vector3d forward = body.linear() * Eigen::Vector3d::UnitX();
  EXPECT_GT(forward.y(), 0.9) << "yaw 0 looks along e's y";
  EXPECT_LT(forward.x(), 0.0) << "counter-clockwise is to the left";
}

TEST(Pose, AnglesAreWrappedToAHalfOpenTurn) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(wrapped(3.0 * pi / 2.0), -pi / 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(wrapped(-pi), pi);
  EXPECT_DOUBLE_EQ(wrapped(0.25), 0.25);
}

TEST(Pose, FinitenessIsOfEveryNumber) {
  Pose pose = Pose::Identity();
  EXPECT_TRUE(is_finite(pose));
  pose.matrix()(1, 3) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_finite(pose));
}

}  // namespace
}  // namespace hogline::vision
