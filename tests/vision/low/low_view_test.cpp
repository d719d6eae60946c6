#include "vision/low_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "tests/vision/low/painted_ice.hpp"
#include "tests/vision/scene.hpp"

namespace hogline::vision {
namespace {

using namespace testing;
using ::testing::Contains;

constexpr double degree = std::numbers::pi / 180.0;

PlanarPose before_hog_line(double distance_m, double x_m = 0.1, double yaw_rad = 1.0 * degree) {
  return {.x_m = x_m, .y_m = rules::tee_to_hog_m - distance_m, .yaw_rad = yaw_rad};
}

// What is asked of single frames, with room for a camera of three quarters of the rig's resolution.
double allowed_m(double distance_m) { return distance_m < 1.5 ? 0.005 : distance_m < 3.5 ? 0.020 : 0.080; }

void expect_seen(const SheetPosePercept& seen, const PaintedSheet& sheet) {
  const double distance_m = rules::tee_to_hog_m - sheet.body.y_m;
  ASSERT_TRUE(seen.ok) << seen.reason;
  EXPECT_NEAR(seen.hog_distance_m, distance_m, allowed_m(distance_m));
  EXPECT_NEAR(seen.body.yaw_rad, sheet.body.yaw_rad, 0.2 * degree);
  EXPECT_NEAR(seen.body.x_m, sheet.body.x_m, 0.02);
  EXPECT_THAT(seen.features, Contains("hog_line"));
  EXPECT_GT(seen.hog_distance_sigma_m, 0.0);
}

struct SheetCase {
  const char* description;
  SidelineKind kind;  ///< what the rig says
  std::optional<double> left_sideline_m;
  std::optional<double> right_sideline_m;
  double width_m;
  bool centre_line;
};

class OnAnySheet : public ::testing::TestWithParam<SheetCase> {};

TEST_P(OnAnySheet, measures_the_hog_line) {
  CameraSetup setup = low_camera();
  setup.sheet.sideline = GetParam().kind;
  LowView view(setup);
  for (const double distance_m : {0.9, 2.2, 5.0}) {
    SCOPED_TRACE(distance_m);
    PaintedSheet sheet;
    sheet.body = before_hog_line(distance_m);
    sheet.left_sideline_m = GetParam().left_sideline_m;
    sheet.right_sideline_m = GetParam().right_sideline_m;
    sheet.width_m = GetParam().width_m;
    sheet.centre_line = GetParam().centre_line;
    expect_seen(view.acquire(paint(setup, sheet), Stamp{}), sheet);
  }
}

INSTANTIATE_TEST_SUITE_P(
    low_view, OnAnySheet,
    ::testing::Values(SheetCase{"painted_sidelines", SidelineKind::line, 0.05, 0.05, 4.75, true},
                      SheetCase{"thin_sidelines", SidelineKind::line, 0.0127, 0.0127, 4.4, true},
                      SheetCase{"foam_dividers", SidelineKind::bumper, 0.2, 0.2, 4.9, true},
                      SheetCase{"no_sidelines", SidelineKind::none, std::nullopt, std::nullopt, 4.75, true},
                      SheetCase{"sidelines_of_unknown_kind", SidelineKind::unknown, 0.05, 0.05, 4.75, true},
                      SheetCase{"left_sideline_only", SidelineKind::line, 0.05, std::nullopt, 4.6, true},
                      SheetCase{"right_sideline_only", SidelineKind::line, std::nullopt, 0.05, 4.6, true}),
    [](const auto& c) { return std::string(c.param.description); });

// The rules know no such sheet.
TEST(low_view, measures_a_sheet_without_centre_line_rightly_or_not_at_all) {
  CameraSetup setup = low_camera();
  setup.sheet.sideline = SidelineKind::line;
  LowView view(setup);
  for (const double distance_m : {0.9, 2.2, 5.0}) {
    SCOPED_TRACE(distance_m);
    PaintedSheet sheet;
    sheet.body = before_hog_line(distance_m);
    sheet.centre_line = false;
    const SheetPosePercept seen = view.acquire(paint(setup, sheet), Stamp{});
    if (seen.ok) expect_seen(seen, sheet);
    EXPECT_EQ(seen.ok, seen.reason.empty());
  }
}

TEST(low_view, is_not_led_astray_by_a_camera_that_leans) {
  CameraSetup setup = low_camera();
  setup.sheet.sideline = SidelineKind::line;
  LowView view(setup);
  for (const double lean : {-0.3 * degree, 0.3 * degree}) {
    PaintedSheet sheet;
    sheet.body = before_hog_line(3.0, -0.2, -2.0 * degree);
    sheet.lean_rad = lean;
    SCOPED_TRACE(lean);
    expect_seen(view.acquire(paint(setup, sheet), Stamp{}), sheet);
  }
}

struct SceneCase {
  const char* name;
  double hog_distance_m;
};

// Path-traced, with blur, noise and JPEG; a logo hides a part of the first scene's hog line.
TEST(low_view, measures_rendered_scenes) {
  for (const SceneCase& c : {SceneCase{"low/low-13-006", 0.722}, SceneCase{"low/low-13-007", 2.737}}) {
    SCOPED_TRACE(c.name);
    const Scene scene = load_scene(c.name);
    LowView view(scene.setup);
    const SheetPosePercept seen = view.acquire(scene.image, Stamp{});
    ASSERT_TRUE(seen.ok) << seen.reason;
    const double distance_m = rules::tee_to_hog_m - scene.body.y_m;
    EXPECT_NEAR(distance_m, c.hog_distance_m, 0.001);
    EXPECT_NEAR(seen.hog_distance_m, distance_m, allowed_m(distance_m));
    EXPECT_NEAR(seen.body.yaw_rad, scene.body.yaw_rad, 0.1 * degree);
  }
}

TEST(low_view, sees_a_hog_line_of_any_colour) {
  const CameraSetup setup = low_camera();
  LowView view(setup);
  for (const Colour& colour : {red, blue, black, yellow}) {
    PaintedSheet sheet;
    sheet.body = before_hog_line(2.5);
    sheet.hog_colour = colour;
    SCOPED_TRACE(colour.transpose());
    expect_seen(view.acquire(paint(setup, sheet), Stamp{}), sheet);
  }
}

TEST(low_view, sees_past_logos_and_reflections_on_the_ice) {
  const CameraSetup setup = low_camera();
  PaintedSheet sheet;
  sheet.body = before_hog_line(1.3);
  sheet.patches = {{{-1.6, -0.3}, {6.0, 6.9}, blue}, {{0.5, 1.5}, {8.0, 8.6}, yellow}};
  for (double y = 5.6; y < 9.0; y += 0.8) sheet.patches.push_back({{0.3, 0.6}, {y, y + 0.2}, Colour(1.0F, 1.0F, 1.0F)});
  LowView view(setup);
  expect_seen(view.acquire(paint(setup, sheet), Stamp{}), sheet);
}

TEST(low_view, owns_up_to_a_response_curve_that_is_not_the_rigs) {
  const Scene scene = load_scene("low/low-13-006");
  for (const double factor : {0.4545, 2.2}) {
    SCOPED_TRACE(factor);
    CameraSetup wrong = scene.setup;
    wrong.gamma *= factor;
    LowView view(wrong);
    const SheetPosePercept seen = view.acquire(scene.image, Stamp{});
    if (!seen.ok) continue;
    const double error_m = seen.hog_distance_m - (rules::tee_to_hog_m - scene.body.y_m);
    EXPECT_LT(std::abs(error_m), 2.5 * seen.hog_distance_sigma_m);
  }
}

struct EmptyCase {
  const char* description;
  void (*change)(PaintedSheet&);
};

class WithoutAHogLine : public ::testing::TestWithParam<EmptyCase> {};

TEST_P(WithoutAHogLine, never_gives_a_distance) {
  const CameraSetup setup = low_camera();
  PaintedSheet sheet;
  sheet.body = before_hog_line(2.5);
  sheet.hog_line = false;
  GetParam().change(sheet);
  LowView view(setup);
  const cv::Mat image = paint(setup, sheet);
  const SheetPosePercept alone = view.acquire(image, Stamp{});
  EXPECT_FALSE(alone.ok) << alone.hog_distance_m;
  EXPECT_FALSE(alone.reason.empty());

  LowViewPrediction prediction;
  prediction.sheet_width_m = sheet.width_m;
  prediction.body = sheet.body;
  prediction.body_sigma = {.x_m = 0.02, .y_m = 0.05, .yaw_rad = 0.005};
  EXPECT_FALSE(view.acquire(image, Stamp{}, prediction).ok) << "a prediction never replaces seeing";
}

INSTANTIATE_TEST_SUITE_P(
    low_view, WithoutAHogLine,
    ::testing::Values(
        EmptyCase{"nothing_across", [](PaintedSheet&) {}},
        EmptyCase{"a_line_as_thin_as_the_tee_line",
                  [](PaintedSheet& s) {
                    s.patches.push_back({{-3.0, 3.0}, {rules::tee_to_hog_m, rules::tee_to_hog_m + 0.0127}, black});
                  }},
        EmptyCase{"the_tee_line_ahead", [](PaintedSheet& s) { s.body.y_m = -2.6; }},
        EmptyCase{"courtesy_lines",
                  [](PaintedSheet& s) {
                    const double y = rules::tee_to_hog_m + rules::courtesy_to_hog_m;
                    s.patches.push_back({{-2.375, -2.223}, {y, y + 0.0127}, black});
                    s.patches.push_back({{2.223, 2.375}, {y, y + 0.0127}, black});
                  }},
        EmptyCase{"a_line_of_four_centimetres",
                  [](PaintedSheet& s) {
                    s.patches.push_back({{-3.0, 3.0}, {rules::tee_to_hog_m, rules::tee_to_hog_m + 0.04}, black});
                  }},
        EmptyCase{"a_band_of_half_a_metre",
                  [](PaintedSheet& s) {
                    s.patches.push_back({{-3.0, 3.0}, {rules::tee_to_hog_m, rules::tee_to_hog_m + 0.5}, blue});
                  }},
        EmptyCase{"a_short_bar",
                  [](PaintedSheet& s) {
                    s.patches.push_back({{-1.5, 0.4}, {rules::tee_to_hog_m, rules::tee_to_hog_m + 0.1}, red});
                  }},
        EmptyCase{"the_other_ends_hog_line",
                  [](PaintedSheet& s) {
                    s.hog_line = true;
                    s.house_beyond = true;
                  }},
        EmptyCase{"a_logo",
                  [](PaintedSheet& s) {
                    s.patches.push_back({{-1.5, 1.5}, {6.2, 6.9}, blue});
                  }},
        EmptyCase{"reflections_of_lamps",
                  [](PaintedSheet& s) {
                    for (double y = 5.0; y < 9.0; y += 0.7) {
                      s.patches.push_back({{-1.2, 1.2}, {y, y + 0.15}, Colour(1.0F, 1.0F, 1.0F)});
                    }
                  }},
        EmptyCase{"past_the_hog_line",
                  [](PaintedSheet& s) {
                    s.hog_line = true;
                    s.body.y_m = rules::tee_to_hog_m + 0.3;
                  }}),
    [](const auto& c) { return std::string(c.param.description); });

TEST(low_view, refuses_what_is_no_picture_of_the_sheet) {
  const CameraSetup setup = low_camera();
  LowView view(setup);
  const int rows = setup.intrinsics.height_px;
  const int columns = setup.intrinsics.width_px;
  cv::Mat noise(rows, columns, CV_8UC3);
  cv::theRNG().state = 7;
  cv::randu(noise, 0, 256);
  cv::Mat wall(rows, columns, CV_8UC3, cv::Scalar(150, 150, 150));
  wall.rowRange(rows / 2, rows) = cv::Scalar(90, 100, 110);
  const std::pair<const char*, cv::Mat> pictures[] = {
      {"empty", {}},
      {"black", cv::Mat(rows, columns, CV_8UC3, cv::Scalar(0, 0, 0))},
      {"white", cv::Mat(rows, columns, CV_8UC3, cv::Scalar(255, 255, 255))},
      {"noise", noise},
      {"a wall", wall},
      {"grey", cv::Mat(rows, columns, CV_8UC1, cv::Scalar(150))},
      {"of another size", cv::Mat(480, 640, CV_8UC3, cv::Scalar(200, 200, 200))},
      {"of another type", cv::Mat(rows, columns, CV_32FC1, cv::Scalar(0.5))},
  };
  for (const auto& [description, picture] : pictures) {
    const SheetPosePercept seen = view.acquire(picture, Stamp{});
    EXPECT_FALSE(seen.ok) << description;
    EXPECT_FALSE(seen.reason.empty()) << description;
  }
}

TEST(low_view, a_wrong_prediction_hides_the_line_rather_than_moving_it) {
  const CameraSetup setup = low_camera();
  PaintedSheet sheet;
  sheet.body = before_hog_line(2.5);
  LowViewPrediction prediction;
  prediction.body = before_hog_line(1.5);
  prediction.body_sigma = {.x_m = 0.02, .y_m = 0.02, .yaw_rad = 0.005};
  LowView view(setup);
  EXPECT_FALSE(view.acquire(paint(setup, sheet), Stamp{}, prediction).ok);
}

TEST(low_view, the_same_picture_gives_the_same_answer_whatever_was_seen_before) {
  const CameraSetup setup = low_camera();
  PaintedSheet sheet;
  sheet.body = before_hog_line(2.5);
  const cv::Mat image = paint(setup, sheet);
  LowView fresh(setup);
  LowView used(setup);
  PaintedSheet other = sheet;
  other.body = before_hog_line(1.2, -0.2);
  used.acquire(paint(setup, other), Stamp{});
  EXPECT_EQ(fresh.acquire(image, Stamp{}).eMc, used.acquire(image, Stamp{}).eMc);
}

}  // namespace
}  // namespace hogline::vision
