#include "servo/head_kinematics.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/servo/head_plant.hpp"
#include "tests/servo/rig.hpp"

namespace hogline::servo::test {
namespace {

TEST(HeadKinematics, AtZeroTheCameraLooksAheadAndPositiveTiltLooksDown) {
  const HeadGeometry head = head_geometry();
  const auto axis = [&](double pan, double tilt) -> Eigen::Vector3d {
    return camera_pose(head, {pan, tilt}).bRc.col(2);
  };
  EXPECT_NEAR((axis(0.0, 0.0) - Eigen::Vector3d(1.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_LT(axis(0.0, 0.3).z(), -0.29);
  EXPECT_GT(axis(0.3, 0.0).y(), 0.29) << "positive pan looks left";
}

TEST(HeadKinematics, ABodyLooksAlongTheSheet) {
  const Eigen::Vector3d ahead = in_body({0.5, 10.0, 0.1}, {0.5, -4.0, 0.0});
  EXPECT_NEAR((ahead - Eigen::Vector3d(14.0, 0.0, 0.1)).norm(), 0.0, 1e-12);
  EXPECT_LT(in_body({1.5, 10.0, 0.0}, {0.5, -4.0, 0.0}).y(), 0.0) << "e's right is b's right";
  EXPECT_LT(in_body({0.5, 10.0, 0.0}, {0.5, -4.0, 0.1}).y(), 0.0) << "turned left, what was ahead is to the right";
}

RC_GTEST_PROP(HeadKinematicsProperty, TheJacobianIsTheDifference, ()) {
  const HeadGeometry head = head_geometry(0.1, -0.05);
  const HeadAngles q{1e-3 * *rc::gen::inRange(-1500, 1500), 1e-3 * *rc::gen::inRange(-300, 1200)};
  const Eigen::Matrix<double, 6, 2> j = camera_jacobian(head, q);
  const double h = 1e-6;
  for (int k = 0; k < 2; ++k) {
    const HeadAngles more{q.pan_rad + (k == 0 ? h : 0.0), q.tilt_rad + (k == 1 ? h : 0.0)};
    const HeadAngles less{q.pan_rad - (k == 0 ? h : 0.0), q.tilt_rad - (k == 1 ? h : 0.0)};
    const HeadPose a = camera_pose(head, less), b = camera_pose(head, more), at = camera_pose(head, q);
    const Eigen::Vector3d v = at.bRc.transpose() * (b.bPc - a.bPc) / (2.0 * h);
    const Eigen::Matrix3d w = at.bRc.transpose() * (b.bRc - a.bRc) / (2.0 * h);
    RC_ASSERT((v - j.col(k).head<3>()).norm() < 1e-6);
    RC_ASSERT((Eigen::Vector3d(w(2, 1), w(0, 2), w(1, 0)) - j.col(k).tail<3>()).norm() < 1e-6);
  }
}

RC_GTEST_PROP(HeadKinematicsProperty, TheAnglesForAPlaceShowItOnTheAxis, ()) {
  const HeadGeometry head = head_geometry(0.2, 0.1);
  const Eigen::Vector3d bP(1e-3 * *rc::gen::inRange(2000, 35000), 1e-3 * *rc::gen::inRange(-2500, 2500), 0.06);
  const auto q = angles_for(head, bP);
  RC_ASSERT(q.has_value());
  const auto point = seen(head, *q, bP);
  RC_ASSERT(point.has_value());
  RC_ASSERT(std::hypot(point->x, point->y) < 1e-6);
}

TEST(HeadKinematics, WhatIsBehindIsNotSeen) { EXPECT_FALSE(seen(head_geometry(), {0.0, 0.0}, {-3.0, 0.0, 1.0})); }

TEST(GazeTask, TurnsTheHeadByGainTimesErrorAndAlongWithTheStone) {
  const HeadGeometry head = head_geometry();
  GazeTask task(head, {.at_zero_per_s = 4.0, .at_infinity_per_s = 4.0, .slope_per_s = 10.0});
  const Eigen::Vector3d bP(20.0, 1.0, 0.06);
  const HeadAngles there = *angles_for(head, bP);
  const HeadAngles q{there.pan_rad - 0.01, there.tilt_rad + 0.005};
  const GazeLaw still = task.law(q, *seen(head, q, bP), 0.0, 0.0);
  ASSERT_TRUE(still.ok) << still.reason;
  EXPECT_NEAR(still.pan_radps, 0.04, 1e-3);
  EXPECT_NEAR(still.tilt_radps, -0.02, 1e-3);
  const double h = 1e-3;
  const Eigen::Vector3d moved = bP + h * Eigen::Vector3d(-2.0, 0.3, 0.0);
  const SeenPoint a = *seen(head, there, bP), b = *seen(head, there, moved);
  const GazeLaw along = task.law(there, a, (b.x - a.x) / h, (b.y - a.y) / h);
  const HeadAngles then = *angles_for(head, moved);
  EXPECT_NEAR(along.pan_radps, (then.pan_rad - there.pan_rad) / h, 1e-4);
  EXPECT_NEAR(along.tilt_radps, (then.tilt_rad - there.tilt_rad) / h, 1e-4);
}

TEST(GazeTask, RefusesWhatItCanNotSee) {
  GazeTask task(head_geometry(), {.at_zero_per_s = 4.0, .at_infinity_per_s = 4.0, .slope_per_s = 10.0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(task.law({}, {nan, 0.0, 5.0}, 0.0, 0.0).ok);
  EXPECT_FALSE(task.law({}, {0.0, 0.0, -1.0}, 0.0, 0.0).ok);
  EXPECT_FALSE(task.law({}, {5.0, 0.0, 2.0}, 0.0, 0.0).ok);
  EXPECT_FALSE(task.law({nan, 0.0}, {0.0, 0.0, 2.0}, 0.0, 0.0).ok);
  EXPECT_TRUE(task.law({}, {0.01, 0.0, 5.0}, 0.0, 0.0).ok) << "recovers";
}

}  // namespace
}  // namespace hogline::servo::test
