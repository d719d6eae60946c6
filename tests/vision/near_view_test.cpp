#include "vision/near_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/vision/scene.hpp"

namespace hogline::vision {
namespace {

using testing::load_scene;
using testing::Scene;

constexpr double degree = std::numbers::pi / 180.0;

struct SceneCase {
  const char* description;
  const char* name;
};

void PrintTo(const SceneCase& c, std::ostream* out) { *out << c.description; }

class NearViewScenes : public ::testing::TestWithParam<SceneCase> {};

TEST_P(NearViewScenes, PoseIsTheTrueOne) {
  const Scene scene = load_scene(GetParam().name);
  NearView near(scene.setup);
  NearViewSketch sketch;
  const Stamp stamp{std::chrono::seconds(5)};
  const SheetPosePercept p = near.acquire(scene.image, stamp, &sketch);
  ASSERT_TRUE(p.ok) << p.reason;
  EXPECT_EQ(p.reason, "");
  EXPECT_EQ(p.stamp, stamp);
  EXPECT_NEAR(p.body.yaw_rad, scene.body.yaw_rad, 0.02 * degree);
  EXPECT_NEAR(p.body.x_m, scene.body.x_m, 0.003);
  EXPECT_NEAR(p.body.y_m, scene.body.y_m, 0.003);
  EXPECT_NEAR(p.hog_distance_m, rules::tee_to_hog_m - scene.body.y_m, 0.003);
  EXPECT_LT((from_row_major(p.eMc).translation() - scene.eMc.translation()).norm(), 0.005);
  EXPECT_GT(p.sigma.yaw_rad, 0.0);
  EXPECT_LT(std::abs(p.body.yaw_rad - scene.body.yaw_rad), 5.0 * p.sigma.yaw_rad);
  EXPECT_GT(p.sites_used, 200);
  EXPECT_FALSE(p.features.empty());
  EXPECT_FALSE(sketch.hog_candidates.empty());
  EXPECT_FALSE(sketch.model.empty());
  if (p.sheet_width_m) {
    EXPECT_NEAR(*p.sheet_width_m, scene.sheet_width_m, 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, NearViewScenes,
                         ::testing::Values(SceneCase{"plain", "near/near-11-000"},
                                           SceneCase{"no sidelines, ring cut by the border", "near/near-11-003"},
                                           SceneCase{"gamma 2.2, dividers", "near/near-11-009"},
                                           SceneCase{"skip, stones on the ring", "skip/skip-12-002"}));

TEST(NearView, MissingSidelinesAreNotFatalAndAreSaid) {
  const Scene scene = load_scene("near/near-11-003");
  ASSERT_EQ(scene.sideline, "none");
  const SheetPosePercept p = NearView(scene.setup).acquire(scene.image, {});
  ASSERT_TRUE(p.ok) << p.reason;
  EXPECT_FALSE(p.sheet_width_m);
  for (const std::string& f : p.features) EXPECT_EQ(f.find("sideline"), std::string::npos) << f;
}

TEST(NearView, SameEveryTimeAndAfterABadPicture) {
  const Scene scene = load_scene("near/near-11-000");
  NearView near(scene.setup);
  const SheetPosePercept first = near.acquire(scene.image, {});
  const SheetPosePercept bad = near.acquire(cv::Mat::zeros(1200, 1600, CV_8UC3), {});
  const SheetPosePercept again = near.acquire(scene.image, {});
  ASSERT_TRUE(first.ok && again.ok);
  EXPECT_FALSE(bad.ok);
  EXPECT_EQ(first.eMc, again.eMc);
}

// A person before the ring, as a dark upright bar, and glare: some of the paint hidden.
TEST(NearView, StandsPartlyHiddenPaint) {
  Scene scene = load_scene("near/near-11-000");
  cv::rectangle(scene.image, {700, 250, 110, 520}, cv::Scalar(40, 60, 200), cv::FILLED);
  cv::ellipse(scene.image, {980, 760}, {120, 60}, 10.0, 0.0, 360.0, cv::Scalar::all(250), cv::FILLED);
  const SheetPosePercept p = NearView(scene.setup).acquire(scene.image, {});
  ASSERT_TRUE(p.ok) << p.reason;
  EXPECT_NEAR(p.body.yaw_rad, scene.body.yaw_rad, 0.05 * degree);
  EXPECT_NEAR(p.body.x_m, scene.body.x_m, 0.006);
  EXPECT_NEAR(p.body.y_m, scene.body.y_m, 0.006);
}

struct BadCase {
  const char* description;
  std::function<cv::Mat()> picture;
};

void PrintTo(const BadCase& c, std::ostream* out) { *out << c.description; }

cv::Mat filled(double value) { return cv::Mat(1200, 1600, CV_8UC3, cv::Scalar::all(value)); }

cv::Mat noise() {
  cv::Mat m = filled(0);
  cv::RNG random(7);
  random.fill(m, cv::RNG::UNIFORM, 0, 256);
  return m;
}

cv::Mat wall() {
  cv::Mat m = filled(0);
  for (int r = 0; r < m.rows; ++r) m.row(r).setTo(cv::Scalar::all(60.0 + 160.0 * r / m.rows));
  return m;
}

cv::Mat brick_wall() {
  cv::Mat m = filled(210);
  for (int r = 0; r < 1200; r += 75) {
    cv::line(m, {0, r}, {1600, r}, cv::Scalar(60, 70, 90), 5);
    for (int c = (r / 75 % 2) * 75; c < 1600; c += 150) cv::line(m, {c, r}, {c, r + 75}, cv::Scalar(60, 70, 90), 5);
  }
  return m;
}

cv::Mat stone_close_up() {
  cv::Mat m = filled(225);
  cv::ellipse(m, {800, 620}, {620, 430}, 0.0, 0.0, 360.0, cv::Scalar(110, 110, 110), cv::FILLED);
  cv::ellipse(m, {800, 560}, {400, 260}, 0.0, 0.0, 360.0, cv::Scalar(30, 30, 190), cv::FILLED);
  cv::rectangle(m, {560, 480, 480, 70}, cv::Scalar(20, 20, 120), cv::FILLED);
  return m;
}

cv::Mat target() {
  cv::Mat m = filled(230);
  for (int k = 0; k < 5; ++k)
    cv::circle(m, {800, 650}, 500 - 100 * k, k % 2 == 0 ? cv::Scalar(160, 40, 20) : cv::Scalar::all(230), cv::FILLED);
  return m;
}

cv::Mat turned(int code) {
  cv::Mat m;
  cv::rotate(load_scene("near/near-11-000").image, m, code);
  if (m.size() != cv::Size(1600, 1200)) cv::resize(m, m, {1600, 1200});
  return m;
}

// As a camera mounted otherwise would see it, which no pose can explain.
cv::Mat shifted(double right_px) {
  cv::Mat m;
  cv::warpAffine(load_scene("near/near-11-000").image, m, cv::Matx23d(1.0, 0.0, right_px, 0.0, 1.0, 0.0), {1600, 1200});
  return m;
}

cv::Mat converted(int type) {
  cv::Mat m;
  if (CV_MAT_CN(type) == 1) {
    cv::cvtColor(load_scene("near/near-11-000").image, m, cv::COLOR_BGR2GRAY);
  } else {
    load_scene("near/near-11-000").image.convertTo(m, type);
  }
  return m;
}

class NearViewRefuses : public ::testing::TestWithParam<BadCase> {};

TEST_P(NearViewRefuses, WithAReasonAndWithoutAnException) {
  const Scene scene = load_scene("near/near-11-000");
  NearView near(scene.setup);
  SheetPosePercept p;
  ASSERT_NO_THROW(p = near.acquire(GetParam().picture(), {}));
  EXPECT_FALSE(p.ok) << "x " << p.body.x_m << " y " << p.body.y_m << " yaw " << p.body.yaw_rad;
  EXPECT_FALSE(p.reason.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Pictures, NearViewRefuses,
    ::testing::Values(BadCase{"black", [] { return filled(0); }}, BadCase{"white", [] { return filled(255); }},
                      BadCase{"uniform grey", [] { return filled(128); }}, BadCase{"noise", noise},
                      BadCase{"gradient wall", wall}, BadCase{"brick wall", brick_wall},
                      BadCase{"close-up of a stone", stone_close_up}, BadCase{"rings on a wall", target},
                      BadCase{"turned left", [] { return turned(cv::ROTATE_90_COUNTERCLOCKWISE); }},
                      BadCase{"turned right", [] { return turned(cv::ROTATE_90_CLOCKWISE); }},
                      BadCase{"upside down", [] { return turned(cv::ROTATE_180); }},
                      BadCase{"another mount's: shifted by 60 px", [] { return shifted(60.0); }},
                      BadCase{"empty", [] { return cv::Mat(); }},
                      BadCase{"wrong size", [] { return cv::Mat(600, 800, CV_8UC3, cv::Scalar::all(200)); }},
                      BadCase{"grey picture of a sheet", [] { return converted(CV_8UC1); }},
                      BadCase{"float", [] { return converted(CV_32FC3); }}));

}  // namespace
}  // namespace hogline::vision
