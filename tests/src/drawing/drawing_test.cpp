// Drawings: the same call gives the same bytes, and no data makes them fail.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "src/drawing/contact_sheet.hpp"
#include "src/drawing/picture_overlay.hpp"
#include "src/drawing/plot.hpp"
#include "src/drawing/sheet_plan.hpp"

namespace hogline::drawing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

// The share of pixels that are nearly of this ink.
double share_of(const cv::Mat& picture, const Ink& ink) {
  cv::Mat found;
  const cv::Scalar bgr(ink.blue, ink.green, ink.red);
  cv::inRange(picture, bgr - cv::Scalar::all(12), bgr + cv::Scalar::all(12), found);
  return cv::countNonZero(found) / static_cast<double>(picture.total());
}

Plot with(const Series& s) {
  Plot plot;
  plot.title = "speed";
  plot.x_label = "time / s";
  plot.y_label = "speed / (m/s)";
  plot.series = {s};
  return plot;
}

TEST(Plot, DrawsEverySeriesInItsInkAndStyle) {
  for (const SeriesStyle style : {SeriesStyle::line, SeriesStyle::dashed, SeriesStyle::dots}) {
    Series s{"truth", {}, {}, inks::red, style};
    for (int i = 0; i < 100; ++i) {
      s.x.push_back(0.05 * i);
      s.y.push_back(std::sin(0.1 * i));
    }
    const cv::Mat drawn = draw_plot(with(s), {640, 240});
    EXPECT_EQ(drawn.size(), cv::Size(640, 240));
    EXPECT_GT(share_of(drawn, inks::red), 0.001);
    EXPECT_TRUE(same(drawn, draw_plot(with(s), {640, 240})));
  }
}

TEST(Plot, SurvivesEveryKindOfMissingData) {
  struct Case {
    const char* what;
    std::vector<double> x, y;
  };
  const std::vector<Case> cases = {
      {"nothing", {}, {}},
      {"one point", {1.0}, {2.0}},
      {"a constant", {0.0, 1.0, 2.0}, {5.0, 5.0, 5.0}},
      {"zero everywhere", {0.0, 0.0}, {0.0, 0.0}},
      {"not a number throughout", {nan, nan}, {nan, 1.0}},
      {"a gap", {0.0, 1.0, nan, 3.0}, {0.0, nan, 2.0, 3.0}},
      {"infinite", {0.0, 1.0, 2.0}, {inf, -inf, 1.0}},
      {"lengths that differ", {0.0, 1.0, 2.0, 3.0}, {1.0}},
      {"huge", {0.0, 1.0}, {-1e300, 1e300}},
      {"tiny differences of large numbers", {1e9, 1e9 + 1e-6}, {1.0, 1.0 + 1e-15}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    Plot plot = with({"s", c.x, c.y, inks::blue, SeriesStyle::line});
    plot.marks = {{nan, "never"}, {1.0, "release"}};
    EXPECT_EQ(draw_plot(plot, {400, 200}).size(), cv::Size(400, 200));
    plot.y_low = 3.0;
    plot.y_high = nan;
    EXPECT_EQ(draw_plot(plot, {400, 200}).size(), cv::Size(400, 200));
  }
  EXPECT_EQ(draw_plots({with({}), with({})}, {300, 150}).size(), cv::Size(300, 300));
}

TEST(Plot, TicksAreRoundAndInside) {
  for (const auto& [low, high] : {std::pair{0.0, 1.0}, {-3.7, 12.1}, {9.914, 10.059}, {1e-6, 3e-6}, {-1e6, 1e6}}) {
    const auto ticks = axis_ticks(low, high, 6);
    ASSERT_GE(ticks.size(), 2U) << low << " to " << high;
    EXPECT_LE(ticks.size(), 12U);
    const double step = ticks[1] - ticks[0];
    const double lead = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(lead - 1) < 1e-6 || std::abs(lead - 2) < 1e-6 || std::abs(lead - 5) < 1e-6) << lead;
    EXPECT_GE(ticks.front(), low - 1e-6 * step);
    EXPECT_LE(ticks.back(), high + 1e-6 * step);
  }
}

SheetPlan plan() {
  SheetPlan p;
  p.title = "throw";
  p.tracks = {{"robot", {{0.0, -4.0}, {0.0, 1.0}, {nan, nan}, {0.1, 6.0}}, inks::blue, false}};
  p.stones = {{{0.4, 34.2}, 0.3, inks::yellow, "1", true}};
  Eigen::Matrix2d c;
  c << 0.01, 0.002, 0.002, 0.09;
  p.ellipses = {{{0.4, 34.2}, c, 2.0, inks::purple}};
  p.marks = {{"release", {0.0, 5.9}, inks::red}};
  return p;
}

TEST(SheetPlan, IsWideForAThrowToTheRightAndTallForOneUp) {
  SheetPlan p = plan();
  const cv::Mat wide = draw_sheet_plan(p, 1600);
  EXPECT_EQ(wide.cols, 1600);
  EXPECT_LT(wide.rows, 400);
  EXPECT_GT(share_of(wide, p.rings[0]), 0.01);
  EXPECT_TRUE(same(wide, draw_sheet_plan(p, 1600)));
  p.direction = ThrowDirection::up;
  const cv::Mat tall = draw_sheet_plan(p, 1600);
  EXPECT_EQ(tall.rows, 1600);
  EXPECT_LT(tall.cols, 400);
}

TEST(SheetPlan, RightOfTheThrowIsDownInAWidePictureAndRightInATallOne) {
  SheetPlan p;
  p.from_y_m = 30.0;
  p.stones = {{{1.5, 34.747}, 0.0, inks::green, "", false}};
  const auto centre = [](const cv::Mat& picture) {
    cv::Mat found;
    cv::inRange(picture, cv::Scalar(110, 153, 0), cv::Scalar(120, 163, 5), found);
    const cv::Moments m = cv::moments(found, true);
    return cv::Point2d(m.m10 / m.m00 / picture.cols, m.m01 / m.m00 / picture.rows);
  };
  EXPECT_GT(centre(draw_sheet_plan(p, 900)).y, 0.6);
  p.direction = ThrowDirection::up;
  EXPECT_GT(centre(draw_sheet_plan(p, 900)).x, 0.6);
}

TEST(SheetPlan, SurvivesWhatIsNotFinite) {
  SheetPlan p = plan();
  p.stones.push_back({{nan, 3.0}, nan, inks::red, "x", true});
  p.stones.push_back({{1e200, 3.0}, 0.0, inks::red, "far", false});
  p.ellipses.push_back({{0.0, 1.0}, Eigen::Matrix2d::Constant(nan), 2.0, inks::red});
  p.ellipses.push_back({{0.0, 1.0}, -Eigen::Matrix2d::Identity(), 2.0, inks::red});
  p.marks.push_back({"nowhere", {inf, nan}, inks::red});
  p.tracks.push_back({"empty", {}, inks::red, true});
  EXPECT_EQ(draw_sheet_plan(p, 800).cols, 800);
}

SheetPosePercept seen() {
  SheetPosePercept p;
  p.ok = true;
  p.body = {-0.26, -3.42, 0.08};
  p.sheet_width_m = 4.57;
  p.sites_used = 400;
  return p;
}

TEST(PictureOverlay, DrawsOnACopyAndSaysWhatWasSeen) {
  const cv::Mat picture(600, 800, CV_8UC3, cv::Scalar::all(120));
  vision::NearViewSketch sketch;
  sketch.four_points = {{100, 300}, {700, 300}, {400, 250}, {400, 500}};
  sketch.model = {{{50, 400}, {750, 420}}, {{nan, nan}, {10, 10}}, {}};
  sketch.ring_contour = {{200, 200}, {nan, 5}, {1e12, 3}};
  const cv::Mat drawn = draw_near_view(picture, seen(), sketch);
  EXPECT_EQ(drawn.size(), picture.size());
  EXPECT_EQ(cv::norm(picture, cv::Mat(600, 800, CV_8UC3, cv::Scalar::all(120)), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(drawn, picture, cv::NORM_L1), 0.0);
  EXPECT_TRUE(same(drawn, draw_near_view(picture, seen(), sketch)));

  SheetPosePercept blind;
  blind.reason = "no ring";
  EXPECT_FALSE(same(drawn, draw_near_view(picture, blind, {})));
}

TEST(PictureOverlay, TakesGreyPicturesAndEmptySketches) {
  const cv::Mat grey(480, 640, CV_8UC1, cv::Scalar(90));
  EXPECT_EQ(draw_low_view(grey, seen(), {}).type(), CV_8UC3);
  EXPECT_EQ(draw_low_view(grey, SheetPosePercept{}, {}).type(), CV_8UC3);
  EXPECT_EQ(draw_near_view(grey, SheetPosePercept{}, {}).type(), CV_8UC3);
}

TEST(ContactSheet, FillsThePageAndLeavesOutWhatIsMissing) {
  const cv::Mat a(300, 400, CV_8UC3, cv::Scalar(200, 0, 0));
  const cv::Mat b(100, 800, CV_8UC3, cv::Scalar(0, 200, 0));
  const cv::Mat page = draw_contact_sheet({{{a, "first"}, {cv::Mat(), "missing"}, {a, ""}}, {{b, ""}}, {}}, 1000);
  EXPECT_EQ(page.cols, 1000);
  EXPECT_GT(share_of(page, {0, 0, 200}), 0.2);
  EXPECT_GT(share_of(page, {0, 200, 0}), 0.1);
  EXPECT_GT(draw_contact_sheet({}, 300).rows, 0);
}

}  // namespace
}  // namespace hogline::drawing
