#include "vision/fit/sheet_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "tests/vision/low/painted_ice.hpp"

namespace hogline::vision {
namespace {

using testing::low_camera;
using testing::paint;
using testing::PaintedSheet;

constexpr double deg = std::numbers::pi / 180.0;

CameraSetup camera_with_lines() {
  CameraSetup setup = low_camera();
  setup.sheet.sideline = SidelineKind::line;
  return setup;
}

SheetFitStart start_at(const CameraSetup& setup, const PlanarPose& body) {
  SheetFitStart start;
  start.eMc = eMb(body) * bMc(setup.mount);
  start.search_px = 16.0;
  start.sheet_width_m = 4.75;
  start.roll_sigma_rad = start.pitch_sigma_rad = 0.5 * deg;
  start.height_sigma_m = 0.005;
  return start;
}

struct Painted {
  const char* what;
  PlanarPose body;
  double lean_rad;
  testing::Colour hog;
  testing::Colour line;
};

class PaintedSheets : public ::testing::TestWithParam<Painted> {};

TEST_P(PaintedSheets, AreFittedWhateverTheirColours) {
  const Painted& p = GetParam();
  const CameraSetup setup = camera_with_lines();
  PaintedSheet sheet;
  sheet.body = p.body;
  sheet.lean_rad = p.lean_rad;
  sheet.hog_colour = p.hog;
  sheet.line_colour = p.line;
  const cv::Mat image = paint(setup, sheet);
  SheetFit fit(setup);
  PlanarPose off = p.body;
  off.x_m += 0.02;
  off.yaw_rad += 0.3 * deg;
  const SheetFitResult& result = fit.fit(image, start_at(setup, off));
  ASSERT_TRUE(result.ok) << p.what << ": " << result.reason;
  EXPECT_NEAR(result.body.x_m, p.body.x_m, 0.003) << p.what;
  EXPECT_NEAR(result.body.y_m, p.body.y_m, 0.01) << p.what;
  EXPECT_NEAR(result.body.yaw_rad / deg, p.body.yaw_rad / deg, 0.05) << p.what;
}

INSTANTIATE_TEST_SUITE_P(
    Palettes, PaintedSheets,
    ::testing::Values(Painted{"red hog line, black lines", {0.1, 4.6, 0.01}, 0.0, testing::red, testing::black},
                      Painted{"leaning by 0.2 degrees", {0.0, 4.4, -0.02}, 0.2 * deg, testing::red, testing::blue},
                      Painted{"yellow hog line", {-0.15, 5.0, 0.015}, 0.0, testing::yellow, testing::black}));

TEST(SheetFit, CanNotTellTheDistanceWithoutALineAcross) {
  const CameraSetup setup = camera_with_lines();
  PaintedSheet sheet;
  sheet.body = {0.0, 4.6, 0.0};
  sheet.hog_line = false;
  SheetFit fit(setup);
  const SheetFitResult& result = fit.fit(paint(setup, sheet), start_at(setup, sheet.body));
  EXPECT_FALSE(result.ok);
  EXPECT_FALSE(result.reason.empty());
}

struct Useless {
  const char* what;
  cv::Mat image;
};

TEST(SheetFit, RefusesWhatShowsNoSheet) {
  const CameraSetup setup = camera_with_lines();
  const cv::Size size(setup.intrinsics.width_px, setup.intrinsics.height_px);
  cv::Mat noise(size, CV_8UC3);
  cv::RNG random(7);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  const Useless cases[] = {
      {"nothing", {}},
      {"too small", cv::Mat::zeros(100, 100, CV_8UC3)},
      {"floating point", cv::Mat::zeros(size, CV_32FC3)},
      {"four channels", cv::Mat::zeros(size, CV_8UC4)},
      {"black", cv::Mat::zeros(size, CV_8UC3)},
      {"white", cv::Mat(size, CV_8UC3, cv::Scalar::all(255))},
      {"grey", cv::Mat(size, CV_8UC1, cv::Scalar::all(128))},
      {"noise", noise},
  };
  SheetFit fit(setup);
  for (const Useless& c : cases) {
    const SheetFitResult& result = fit.fit(c.image, start_at(setup, {0.0, 4.6, 0.0}));
    EXPECT_FALSE(result.ok) << c.what;
    EXPECT_FALSE(result.reason.empty()) << c.what;
  }
}

TEST(SheetFit, RefusesAStartThatIsNoPoseAndRecovers) {
  const CameraSetup setup = camera_with_lines();
  PaintedSheet sheet;
  sheet.body = {0.0, 4.6, 0.0};
  const cv::Mat image = paint(setup, sheet);
  SheetFit fit(setup);
  SheetFitStart start = start_at(setup, sheet.body);
  start.eMc.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fit.fit(image, start).ok);
  start = start_at(setup, sheet.body);
  start.eMc.translation().z() = -0.5;
  EXPECT_FALSE(fit.fit(image, start).ok);
  EXPECT_TRUE(fit.fit(image, start_at(setup, sheet.body)).ok);
}

TEST(SheetFit, GivesTheSameAnswerEachTime) {
  const CameraSetup setup = camera_with_lines();
  PaintedSheet sheet;
  sheet.body = {0.05, 4.8, 0.01};
  const cv::Mat image = paint(setup, sheet);
  SheetFit fit(setup);
  const SheetFitResult first = fit.fit(image, start_at(setup, {0.06, 4.8, 0.012}));
  const SheetFitResult second = SheetFit(setup).fit(image, start_at(setup, {0.06, 4.8, 0.012}));
  ASSERT_TRUE(first.ok) << first.reason;
  EXPECT_EQ(first.eMc.matrix(), second.eMc.matrix());
  EXPECT_EQ(first.covariance, second.covariance);
  EXPECT_EQ(first.eMc.matrix(), fit.fit(image, start_at(setup, {0.06, 4.8, 0.012})).eMc.matrix());
}

}  // namespace
}  // namespace hogline::vision
