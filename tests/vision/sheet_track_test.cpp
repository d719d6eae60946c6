// The joint fit from frame to frame: whatever the prediction's error within the search, the answer is the whole fit's.
#include "vision/fit/sheet_track.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>

#include "tests/support/random_scene.hpp"
#include "tests/vision/low/painted_ice.hpp"
#include "tests/vision/scene.hpp"

namespace hogline::vision {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Offset {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
};

// `off` is how wrong it is; the covariance says a little more than that.
SheetPrediction prediction_about(const Pose& eMc, const Offset& off) {
  SheetPrediction p;
  const Eigen::Matrix3d eRc = eMc.linear();
  p.eMc = eMc;
  p.eMc.linear() = Eigen::AngleAxisd(off.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() * eRc *
                   Eigen::AngleAxisd(off.pitch_rad, Eigen::Vector3d::UnitX()).toRotationMatrix();
  p.eMc.translation() += Eigen::Vector3d(off.x_m, off.y_m, 0.0);
  const double place_m = 0.002 + 0.5 * std::max(std::abs(off.x_m), std::abs(off.y_m));
  const Eigen::Vector3d turn(0.001 + 0.5 * std::abs(off.pitch_rad), 0.001 + 0.5 * std::abs(off.pitch_rad),
                             0.0005 + 0.5 * std::abs(off.yaw_rad));
  p.covariance.setZero();
  p.covariance.topLeftCorner<3, 3>() = place_m * place_m * Eigen::Matrix3d::Identity();
  p.covariance.bottomRightCorner<3, 3>() = eRc.transpose() * turn.cwiseAbs2().asDiagonal() * eRc;
  p.travel.setZero();
  return p;
}

constexpr Offset offsets[] = {
    {},
    {.yaw_rad = 0.05 * degree},
    {.yaw_rad = -0.05 * degree},
    {.yaw_rad = 0.2 * degree},
    {.yaw_rad = -0.2 * degree},
    {.yaw_rad = 0.5 * degree},
    {.yaw_rad = -0.5 * degree},
    {.pitch_rad = 0.15 * degree},
    {.pitch_rad = -0.15 * degree},
    {.x_m = 0.015},
    {.y_m = -0.015},
    {.yaw_rad = 0.2 * degree, .pitch_rad = -0.1 * degree, .x_m = -0.008, .y_m = 0.008},
};

class TrackedScene : public ::testing::TestWithParam<const char*> {};

TEST_P(TrackedScene, GivesTheWholeFitsAnswerFromAnyPredictionWithinTheSearch) {
  const testing::Scene scene = testing::load_scene(GetParam());
  SheetTrack track(scene.setup);
  SheetFitStart start;
  start.eMc = eMb(scene.body) * bMc(scene.setup.mount);
  const SheetFitResult whole = track.begin(scene.image, start);
  ASSERT_TRUE(whole.ok) << whole.reason;
  for (const Offset& off : offsets) {
    const SheetFitResult& r = track.follow(scene.image, prediction_about(whole.eMc, off));
    ASSERT_TRUE(r.ok) << r.reason << " from yaw " << off.yaw_rad / degree << " x " << off.x_m;
    EXPECT_NEAR(r.body.yaw_rad, whole.body.yaw_rad, 0.004 * degree);
    EXPECT_NEAR(r.body.x_m, whole.body.x_m, 0.001);
    EXPECT_NEAR(r.body.y_m, whole.body.y_m, 0.001);
    EXPECT_LT(r.sites_tried, 250) << "a few hundred places, not all";
    EXPECT_LT(track.diagnosis().innovation, 3.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, TrackedScene,
                         ::testing::Values("near/near-11-000", "near/near-11-003", "skip/skip-12-002"),
                         [](const auto& row) {
                           std::string name = row.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return c == '/' || c == '-'; }, '_');
                           return name;
                         });

// Any club's colours and dividers, stones and people anywhere.
TEST(SheetTrack, SaysHowWrongItIsOnScenesNobodyChose) {
  double normalised_square = 0.0;
  double worst_rad = 0.0;
  int n = 0;
  for (std::uint64_t seed = 301; seed < 309; ++seed) {
    const auto scene = hogline::testing::random_scene(seed);
    const cv::Mat image = hogline::testing::render(scene);
    SheetTrack track(scene.setup);
    SheetFitStart start;
    start.eMc = scene.eMc;
    start.search_px = 4.0;
    const SheetFitResult whole = track.begin(image, start);
    ASSERT_TRUE(whole.ok) << scene.what << ": " << whole.reason;
    for (const Offset& off : offsets) {
      const SheetFitResult& r = track.follow(image, prediction_about(whole.eMc, off));
      ASSERT_TRUE(r.ok) << scene.what << ": " << r.reason;
      const double error = r.body.yaw_rad - scene.body.yaw_rad;
      normalised_square += error * error / (r.sigma.yaw_rad * r.sigma.yaw_rad);
      worst_rad = std::max(worst_rad, std::abs(error));
      ++n;
    }
  }
  EXPECT_LT(worst_rad, 0.02 * degree);
  EXPECT_LT(std::sqrt(normalised_square / n), 1.6);
}

// The search reaches further than its pixels: the places it leads to agree, or are refused.
TEST(SheetTrack, NeverBelievesAWrongPlaceHoweverFarItStarts) {
  const testing::Scene scene = testing::load_scene("skip/skip-12-002");
  SheetTrack track(scene.setup);
  SheetFitStart start;
  start.eMc = eMb(scene.body) * bMc(scene.setup.mount);
  const SheetFitResult whole = track.begin(scene.image, start);
  ASSERT_TRUE(whole.ok);
  int believed = 0;
  for (double yaw_deg = -8.0; yaw_deg <= 8.0; yaw_deg += 0.5) {
    for (const double y_m : {-0.3, 0.0, 0.3}) {
      const SheetFitResult& r =
          track.follow(scene.image, prediction_about(whole.eMc, {.yaw_rad = yaw_deg * degree, .y_m = y_m}));
      if (!r.ok) continue;
      ++believed;
      EXPECT_NEAR(r.body.yaw_rad, whole.body.yaw_rad, 0.01 * degree) << yaw_deg << " degrees, " << y_m << " m off";
      EXPECT_NEAR(r.body.y_m, whole.body.y_m, 0.003) << yaw_deg << " degrees, " << y_m << " m off";
    }
  }
  EXPECT_GE(believed, 4) << "within a degree at least";
}

// Half a metre over the ice at 3 m/s: each frame is 50 mm further.
TEST(SheetTrack, FollowsTheLowCameraOfARunningRobot) {
  const CameraSetup setup = testing::low_camera();
  testing::PaintedSheet sheet;
  sheet.body = {0.05, 4.0, 0.01};
  SheetFitStart start;
  start.eMc = eMb(sheet.body) * bMc(setup.mount);
  start.roll_sigma_rad = start.pitch_sigma_rad = 0.2 * degree;
  start.height_sigma_m = 0.005;
  SheetTrack track(setup);
  ASSERT_TRUE(track.begin(testing::paint(setup, sheet), start).ok) << track.result().reason;
  for (int k = 1; k <= 3; ++k) {
    sheet.body.y_m += 0.05;
    const Pose truth = eMb(sheet.body) * bMc(setup.mount);
    const SheetPrediction prediction =
        prediction_about(truth, {.yaw_rad = 0.05 * degree, .x_m = 0.002, .y_m = k % 2 == 0 ? 0.006 : -0.006});
    const SheetFitResult& r = track.follow(testing::paint(setup, sheet), prediction);
    ASSERT_TRUE(r.ok) << "frame " << k << ": " << r.reason;
    EXPECT_NEAR(r.body.y_m, sheet.body.y_m, 0.015) << "frame " << k;
    EXPECT_NEAR(r.body.yaw_rad, sheet.body.yaw_rad, 0.05 * degree) << "frame " << k;
    EXPECT_LT(std::abs(r.body.y_m - sheet.body.y_m), 3.0 * r.sigma.y_m) << "frame " << k;
  }
}

TEST(SheetTrack, RefusesWhatItCanNotUseAndFollowsAgain) {
  const testing::Scene scene = testing::load_scene("near/near-11-000");
  SheetTrack track(scene.setup);
  SheetFitStart start;
  start.eMc = eMb(scene.body) * bMc(scene.setup.mount);
  const SheetFitResult whole = track.begin(scene.image, start);
  ASSERT_TRUE(whole.ok);
  const SheetPrediction good = prediction_about(whole.eMc, {});
  const auto refused = [&](const char* what, const cv::Mat& image, const SheetPrediction& prediction) {
    const SheetFitResult& r = track.follow(image, prediction);
    EXPECT_FALSE(r.ok) << what;
    EXPECT_FALSE(r.reason.empty()) << what;
    const SheetFitResult& again = track.follow(scene.image, good);
    EXPECT_TRUE(again.ok) << again.reason;
    EXPECT_NEAR(again.body.yaw_rad, whole.body.yaw_rad, 0.004 * degree);
  };
  refused("no picture", cv::Mat(), good);
  refused("small picture", cv::Mat(600, 800, CV_8UC3, cv::Scalar::all(90)), good);
  refused("16 bits", cv::Mat(scene.image.size(), CV_16UC3, cv::Scalar::all(90)), good);
  refused("black", cv::Mat(scene.image.size(), CV_8UC3, cv::Scalar::all(0)), good);
  refused("behind", scene.image, prediction_about(whole.eMc, {.yaw_rad = std::numbers::pi}));

  SheetPrediction broken = good;
  broken.eMc.translation().x() = std::numeric_limits<double>::quiet_NaN();
  refused("no number", scene.image, broken);
  broken = good;
  broken.covariance(5, 5) = std::numeric_limits<double>::infinity();
  refused("endless doubt", scene.image, broken);
  broken = good;
  broken.eMc.translation().z() = -1.0;
  refused("under the ice", scene.image, broken);
}

}  // namespace
}  // namespace hogline::vision
