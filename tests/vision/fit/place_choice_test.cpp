// The tracker's places: as many as wanted, spread over all that is painted, and the same places seen from elsewhere.
#include "vision/fit/place_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "vision/camera_setup.hpp"
#include "vision/fit/paint.hpp"

namespace hogline::vision {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

CameraSetup near_camera() {
  CameraSetup setup;
  setup.intrinsics = {
      1600, 1200, LensModel::brown_conrady, 780.0, 780.0, 803.2, 596.4, {-0.12, 0.015, 0.0003, -0.0002, 0.0}};
  setup.mount = {0.2, 0.0, 2.0, 0.0, 28.0 * degree, 0.0};
  setup.ice = {0.006, 1.309};
  return setup;
}

FitState state_at(const PlanarPose& body) {
  FitState state;
  state.eMc = eMb(body) * bMc(near_camera().mount);
  state.paint_depth_m = 0.006;
  for (Sideline& line : state.sidelines) {
    line.known = true;
    line.edge_m = 2.375;
    line.paint_m = 0.04;
  }
  return state;
}

SheetCamera camera_of(const FitState& state) { return {Lens(near_camera().intrinsics), state.eMc, near_camera().ice}; }

// As a fit leaves it: yaw worse known than the rest.
ParameterMatrix covariance() {
  ParameterVector sigma = ParameterVector::Constant(1e-3);
  sigma.segment<3>(3).setConstant(1e-4);
  return sigma.cwiseAbs2().asDiagonal();
}

BodyByParameters body_by_parameters(const FitState& state) {
  BodyByParameters body = BodyByParameters::Zero();
  body.block<2, 3>(0, 0) = state.eMc.linear().topRows<2>();
  body.block<1, 3>(2, 3) = state.eMc.linear().row(2);
  return body;
}

std::array<int, paint_feature_count> count_by_feature(const std::vector<PlannedSite>& sites) {
  std::array<int, paint_feature_count> count{};
  for (const PlannedSite& site : sites) ++count[static_cast<std::size_t>(site.feature)];
  return count;
}

TEST(PlaceChoice, TakesAsManyAsWantedOfEveryFeatureInView) {
  const FitState state = state_at({0.1, -3.4, 0.05});
  std::vector<PlannedSite> all;
  plan_sites(camera_of(state), state, {}, all);
  for (const int wanted : {100, 180, 300}) {
    PlaceChoice choice(wanted, 2000);
    choice.judge_by(covariance(), body_by_parameters(state));
    std::vector<PlannedSite> sites;
    choice.choose_all(camera_of(state), state, sites);
    EXPECT_NEAR(static_cast<double>(sites.size()), wanted, 0.1 * wanted);
    const auto planned = count_by_feature(all);
    const auto chosen = count_by_feature(sites);
    for (std::size_t f = 0; f < paint_feature_count; ++f) {
      EXPECT_GE(chosen[f], planned[f] >= 20 ? 1 : 0) << paint_features()[f].name << ", " << wanted << " wanted";
    }
  }
}

TEST(PlaceChoice, KeepsItsNumberAndOrderWhileTheRobotTurns) {
  PlanarPose body{0.1, -3.4, -0.1};
  FitState state = state_at(body);
  PlaceChoice choice(180, 2000);
  choice.judge_by(covariance(), body_by_parameters(state));
  std::vector<PlannedSite> sites;
  choice.choose_all(camera_of(state), state, sites);
  for (int frame = 0; frame < 80; ++frame) {
    body.yaw_rad += 0.25 * degree;
    state = state_at(body);
    choice.renew_one_feature(camera_of(state), state, sites);
    ASSERT_TRUE(std::is_sorted(sites.begin(), sites.end(),
                               [](const PlannedSite& a, const PlannedSite& b) { return a.feature < b.feature; }))
        << "frame " << frame;
    ASSERT_NEAR(static_cast<double>(sites.size()), 180.0, 45.0) << "frame " << frame;
  }
}

TEST(Reproject, SeesAPlannedPlaceWhereThePlannerDoes) {
  constexpr double reach_px = 10.0;  // of a close look from the place
  const FitState state = state_at({0.1, -3.4, 0.05});
  std::vector<PlannedSite> sites;
  plan_sites(camera_of(state), state, {}, sites);
  const SiteCameras cameras(Lens(near_camera().intrinsics), state.eMc, near_camera().ice);
  ASSERT_GT(sites.size(), 300U);
  for (const PlannedSite& planned : sites) {
    PlannedSite seen = planned;
    seen.pixel.setZero();
    seen.normal.setZero();
    seen.along.setZero();
    if (!reproject(cameras, state, seen)) {
      EXPECT_FALSE(cameras.paint.lens().in_picture(planned.pixel, planned.width_px + reach_px))
          << paint_features()[static_cast<std::size_t>(planned.feature)].name << ": only a cut that leaves the picture";
      continue;
    }
    EXPECT_LT((seen.pixel - planned.pixel).norm(), 1e-9);
    EXPECT_LT((seen.normal - planned.normal).norm(), 1e-9);
    EXPECT_LT((seen.along - planned.along).norm(), 1e-6 * planned.along.norm());
    EXPECT_NEAR(seen.width_px, planned.width_px, 1e-9);
  }
}

TEST(Reproject, MovesAPlaceAsItsDerivativesSay) {
  const FitState state = state_at({0.1, -3.4, 0.05});
  std::vector<PlannedSite> sites;
  plan_sites(camera_of(state), state, {}, sites);
  for (int k = 0; k < parameter::count; ++k) {
    const double step = 1e-5;
    const FitState other = moved(state, step * ParameterVector::Unit(k));
    const SiteCameras cameras(Lens(near_camera().intrinsics), other.eMc, {other.paint_depth_m, 1.309});
    for (const PlannedSite& planned : sites) {
      PlannedSite seen = planned;
      if (!reproject(cameras, other, seen)) continue;
      const double by_parameter = planned.normal.dot(seen.pixel - planned.pixel) / step;
      // The pixel of a thin line is its middle in the picture, which is not quite the middle's picture.
      EXPECT_NEAR(by_parameter, planned.along[k], 0.02 * std::abs(planned.along[k]) + 0.5)
          << paint_features()[static_cast<std::size_t>(planned.feature)].name << " parameter " << k;
    }
  }
}

TEST(Reproject, LetsGoOfWhatLeavesThePicture) {
  const FitState state = state_at({0.1, -3.4, 0.05});
  std::vector<PlannedSite> sites;
  plan_sites(camera_of(state), state, {}, sites);
  const FitState turned = state_at({0.1, -3.4, 0.05 + std::numbers::pi});
  const SiteCameras cameras(Lens(near_camera().intrinsics), turned.eMc, near_camera().ice);
  for (const PlannedSite& planned : sites) {
    PlannedSite seen = planned;
    if (planned.pixel.y() < 800.0) {
      EXPECT_FALSE(reproject(cameras, turned, seen));
      EXPECT_EQ(seen.pixel, planned.pixel) << "unchanged where it is refused";
    }
  }
}

}  // namespace
}  // namespace hogline::vision
