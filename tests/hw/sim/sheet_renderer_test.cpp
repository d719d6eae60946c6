// The renderer against vision's exact projection: what is painted must be found where the geometry says.
#include "hw/sim/sheet_renderer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>

#include "vision/geometry/sheet.hpp"
#include "vision/geometry/sheet_camera.hpp"

namespace hogline::hw::sim {
namespace {

using vision::Intrinsics;
using vision::LensModel;
namespace rules = vision::rules;

constexpr double deg = std::numbers::pi / 180.0;

Intrinsics near_lens() {
  return {1600, 1200, LensModel::brown_conrady, 780.0, 780.0, 803.2, 596.4, {-0.12, 0.015, 0.0003, -0.0002, 0.0}};
}
Intrinsics low_lens() {
  return {1600, 1200, LensModel::brown_conrady, 700.0, 700.0, 795.7, 604.1, {-0.11, 0.011, -0.0002, 0.0003, 0.0}};
}
Intrinsics wide_lens() {
  return {1280, 1024, LensModel::kannala_brandt, 520.0, 520.0, 640.2, 511.7, {0.02, -0.003, 0.0, 0.0}};
}
Intrinsics far_lens() {
  return {1600, 1200, LensModel::brown_conrady, 5555.0, 5555.0, 801.5, 598.0, {-0.02, 0.0, 0.0, 0.0, 0.0}};
}

// Even light, no reflections: what is left is paint.
RinkAppearance even() {
  RinkAppearance rink;
  rink.light.vignetting = 0.0;
  rink.light.lamp_gloss = 0.0;
  rink.sheet.ice = {0.9F, 0.9F, 0.9F};
  rink.sheet.rings = {{{0.1F, 0.1F, 0.5F}, {0.9F, 0.9F, 0.9F}, {0.5F, 0.1F, 0.1F}, {0.9F, 0.9F, 0.9F}}};
  return rink;
}

SensorModel noiseless(double gamma) {
  SensorModel sensor;
  sensor.gamma = gamma;
  sensor.noisy = false;
  sensor.blur_sigma_px = 0.7;  // wide enough to interpolate between pixels
  return sensor;
}

struct View {
  std::string what;
  Intrinsics lens;
  vision::Mount mount;
  PlanarPose body;
  double paint_depth_m;
};

vision::Pose camera_pose(const View& view) { return vision::eMb(view.body) * vision::bMc(view.mount); }

std::vector<View> views() {
  return {
      {"near view, straight", near_lens(), {0.2, 0.0, 2.0, 0.0, 28 * deg, 0.0}, {0.0, -3.4, 0.0}, 0.0},
      {"near view, turned, 6 mm of ice",
       near_lens(),
       {0.2, 0.0, 2.0, 0.5 * deg, 28 * deg, 1 * deg},
       {-0.4, -3.2, 7 * deg},
       0.006},
      {"near view, turned back, 12 mm of ice",
       near_lens(),
       {0.2, 0.0, 2.0, 0.0, 27 * deg, 0.0},
       {0.8, -4.5, -11 * deg},
       0.012},
      {"low view, 4 m before the hog line",
       low_lens(),
       {0.45, 0.0, 0.5, 0.0, 20 * deg, 0.0},
       {0.05, 2.4, -2 * deg},
       0.008},
      {"low view, 1 m before the hog line",
       low_lens(),
       {0.45, 0.0, 0.5, 0.3 * deg, 20 * deg, 0.0},
       {-0.1, 5.4, 1 * deg},
       0.008},
      {"wide lens", wide_lens(), {0.2, 0.0, 1.8, 0.0, 40 * deg, 0.0}, {0.3, -2.5, 20 * deg}, 0.006},
      {"far view", far_lens(), {0.2, 0.0, 2.1, 0.0, 9 * deg, 0.0}, {-0.15, -12.0, 1 * deg}, 0.006},
  };
}

float bilinear(const cv::Mat& picture, const Eigen::Vector2d& p, int channel) {
  const int x = static_cast<int>(std::floor(p.x()));
  const int y = static_cast<int>(std::floor(p.y()));
  const auto fx = static_cast<float>(p.x() - x);
  const auto fy = static_cast<float>(p.y() - y);
  const auto at = [&](int v, int u) { return picture.at<cv::Vec3f>(v, u)[channel]; };
  return (1 - fy) * ((1 - fx) * at(y, x) + fx * at(y, x + 1)) + fy * ((1 - fx) * at(y + 1, x) + fx * at(y + 1, x + 1));
}

struct Profile {
  std::vector<double> offset_px;
  std::vector<double> light;
};

Profile across(const cv::Mat& picture, const Eigen::Vector2d& centre, const Eigen::Vector2d& normal, double half_px) {
  Profile profile;
  for (double s = -half_px; s <= half_px; s += 0.05) {
    profile.offset_px.push_back(s);
    profile.light.push_back(static_cast<double>(bilinear(picture, centre + s * normal, 1)));
  }
  return profile;
}

// Where the profile passes half way between its ends.
double half_way(const Profile& p) {
  const double level = 0.5 * (p.light.front() + p.light.back());
  for (std::size_t i = 1; i < p.light.size(); ++i) {
    const double a = p.light[i - 1] - level;
    const double b = p.light[i] - level;
    if (a * b <= 0.0 && a != b) return p.offset_px[i - 1] + 0.05 * a / (a - b);
  }
  return 1e9;
}

// The centre of gravity of what is darker than the straight line between the profile's ends: far ice mirrors the walls.
double centre_of_line(const Profile& p) {
  double mass = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i < p.light.size(); ++i) {
    const double along = static_cast<double>(i) / static_cast<double>(p.light.size() - 1);
    const double dark = (1.0 - along) * p.light.front() + along * p.light.back() - p.light[i];
    mass += dark;
    moment += dark * p.offset_px[i];
  }
  return moment / mass;
}

struct Deviations {
  int count = 0;
  double sum = 0.0;
  double squares = 0.0;
  double worst = 0.0;
  void add(double d) {
    ++count;
    sum += d;
    squares += d * d;
    worst = std::max(worst, std::abs(d));
  }
};

// The picture's normal to a painted curve through `paint` along `tangent`.
Eigen::Vector2d normal_at(const vision::PaintProjection& p, const Eigen::Vector2d& tangent) {
  const Eigen::Vector2d t = (p.by_paint * tangent).normalized();
  return {-t.y(), t.x()};
}

bool usable(const vision::Lens& lens, const std::optional<vision::PaintProjection>& p) {
  return p && lens.in_picture(p->pixel, 8.0);
}

// The place of the outer ring's edge. Beside other lines, and where the ring is thin in the picture, nothing is
// measured.
Deviations ring_deviations(const View& view, const cv::Mat& light) {
  const vision::Lens lens(view.lens);
  const vision::SheetCamera camera(lens, camera_pose(view), {view.paint_depth_m, 1.309});
  Deviations found;
  for (double angle = 0.0; angle < 360.0; angle += 3.0) {
    const Eigen::Vector2d out(std::cos(angle * deg), std::sin(angle * deg));
    const auto p = camera.project_paint_with_jacobian(rules::outer_ring_radius_m * out);
    if (!usable(lens, p) || std::min(std::abs(out.x()), std::abs(out.y())) < 0.25) continue;
    const Eigen::Vector2d n = normal_at(*p, {-out.y(), out.x()});
    if (std::abs((p->by_paint * out).dot(n)) * 0.5 < 8.0) continue;
    found.add(half_way(across(light, p->pixel, n, 4.0)));
  }
  return found;
}

// The centre of the hog line's ridge, or each of its edges where it is wide.
Deviations hog_deviations(const View& view, const cv::Mat& light) {
  const vision::Lens lens(view.lens);
  const vision::SheetCamera camera(lens, camera_pose(view), {view.paint_depth_m, 1.309});
  const auto& line = vision::cross_line("hog_line");
  Deviations found;
  for (double x = -2.2; x < 2.2; x += 0.05) {
    if (std::abs(x) < 0.3) continue;
    const auto middle = camera.project_paint_with_jacobian({x, line.centre_y_m()});
    if (!usable(lens, middle)) continue;
    const Eigen::Vector2d n = normal_at(*middle, {1.0, 0.0});
    const double width_px = std::abs((middle->by_paint * Eigen::Vector2d(0.0, line.width_m())).dot(n));
    if (width_px < 12.0) {
      // Perspective moves the picture's centre of gravity off the projection of the paint's centre.
      const auto near_edge = camera.project_paint({x, line.near_edge_y_m});
      const auto far_edge = camera.project_paint({x, line.far_edge_y_m});
      const double expected = (0.5 * (*near_edge + *far_edge) - middle->pixel).dot(n);
      found.add(centre_of_line(across(light, middle->pixel, n, 0.5 * width_px + 4.0)) - expected);
      continue;
    }
    for (const double y : {line.near_edge_y_m, line.far_edge_y_m}) {
      const auto edge = camera.project_paint_with_jacobian({x, y});
      if (usable(lens, edge)) found.add(half_way(across(light, edge->pixel, normal_at(*edge, {1.0, 0.0}), 4.0)));
    }
  }
  return found;
}

TEST(SheetRenderer, PaintsEdgesWhereTheGeometryProjectsThem) {
  for (const View& view : views()) {
    SCOPED_TRACE(view.what);
    const SheetRenderer renderer(view.lens, {view.paint_depth_m, 1.309}, even(), noiseless(1.0), 1);
    cv::Mat light;
    renderer.render_light({camera_pose(view), {}, 0.0, {}, {}}, light);
    const Deviations ring = ring_deviations(view, light);
    const Deviations hog = hog_deviations(view, light);
    EXPECT_GE(ring.count + hog.count, 20);
    for (const Deviations& d : {ring, hog}) {
      if (d.count == 0) continue;
      EXPECT_LT(std::sqrt(d.squares / d.count), 0.015) << d.count << " places";
      EXPECT_LT(d.worst, 0.035);
      EXPECT_LT(std::abs(d.sum / d.count), 0.003) << "bias";
    }
  }
}

TEST(SheetRenderer, EdgesStayWhereTheyAreInAnEightBitPictureOfAnyResponseCurve) {
  const View view = views()[1];
  for (const double gamma : {1.0, 2.2}) {
    SCOPED_TRACE(gamma);
    const SheetRenderer renderer(view.lens, {view.paint_depth_m, 1.309}, even(), noiseless(gamma), 1);
    cv::Mat bgr;
    renderer.render({camera_pose(view), {}, 0.0, {}, {}}, 7, bgr);
    cv::Mat light;
    bgr.convertTo(light, CV_32FC3, 1.0 / 255.0);
    cv::pow(light, gamma, light);
    const Deviations ring = ring_deviations(view, light);
    EXPECT_LT(std::abs(ring.sum / ring.count), 0.01);
    EXPECT_LT(ring.worst, 0.05);
  }
}

TEST(SheetRenderer, MotionBlurWidensEdgesButDoesNotMoveThem) {
  View view = views()[4];
  const SheetRenderer renderer(view.lens, {view.paint_depth_m, 1.309}, even(), noiseless(1.0), 1);
  cv::Mat still;
  cv::Mat moving;
  Exposure exposure{camera_pose(view), {}, 0.003, {}, {}};
  renderer.render_light(exposure, still);
  exposure.velocity.linear = {0.0, 3.0, 0.0};
  renderer.render_light(exposure, moving);

  const vision::Lens lens(view.lens);
  const vision::SheetCamera camera(lens, camera_pose(view), {view.paint_depth_m, 1.309});
  const auto edge = camera.project_paint_with_jacobian({0.8, rules::tee_to_hog_m});
  ASSERT_TRUE(edge);
  const Eigen::Vector2d n = normal_at(*edge, {1.0, 0.0});
  const double smear_px = std::abs((edge->by_paint * Eigen::Vector2d(0.0, 0.009)).dot(n));
  ASSERT_GT(smear_px, 3.0);
  const auto steepest = [&](const cv::Mat& light) {
    const Profile p = across(light, edge->pixel, n, 8.0);
    double most = 0.0;
    for (std::size_t i = 10; i < p.light.size(); ++i) most = std::max(most, std::abs(p.light[i] - p.light[i - 10]));
    return most;
  };
  EXPECT_LT(std::abs(half_way(across(moving, edge->pixel, n, 8.0))), 0.05);
  EXPECT_LT(steepest(moving), 0.6 * steepest(still));
}

TEST(SheetRenderer, AStoneStandsOnTheIceWhereItIsSaidToBe) {
  const View view = views()[2];
  const SheetRenderer renderer(view.lens, {view.paint_depth_m, 1.309}, even(), noiseless(1.0), 1);
  Exposure exposure{camera_pose(view), {}, 0.0, {}, {}};
  cv::Mat empty;
  renderer.render_light(exposure, empty);
  StoneLook stone;
  stone.x_m = 0.4;
  stone.y_m = -0.9;
  stone.plate = {0.9F, 0.8F, 0.0F};
  exposure.stones.push_back(stone);
  cv::Mat with;
  renderer.render_light(exposure, with);

  const vision::SheetCamera camera(vision::Lens(view.lens), camera_pose(view), {view.paint_depth_m, 1.309});
  // The plate's rim, ahead of and beside the handle: inside it is the plate's colour, outside it is not.
  for (const double angle : {40.0, 140.0, 220.0, 320.0}) {
    const auto rim = [&](double radius) {
      const auto p = camera.project({stone.x_m + radius * std::cos(angle * deg),
                                     stone.y_m + radius * std::sin(angle * deg), stone.plate_height_m});
      return bilinear(with, *p, 0) / bilinear(with, *p, 2);
    };
    EXPECT_LT(rim(stone.plate_radius_m - 0.012), 0.1F) << angle;
    EXPECT_GT(rim(stone.plate_radius_m + 0.030), 0.3F) << angle;
  }
  cv::Mat difference;
  cv::absdiff(empty, with, difference);
  const auto foot = camera.project({0.4, -0.9, 0.0});
  const auto elsewhere = camera.project({-0.8, 0.9, 0.0});
  EXPECT_GT(bilinear(difference, *foot, 1), 0.1F);
  EXPECT_EQ(bilinear(difference, *elsewhere, 1), 0.0F);
}

TEST(SheetRenderer, TheSameSeedGivesTheSameBytesWithAnyNumberOfThreads) {
  const View view = views()[3];
  RinkAppearance rink;
  rink.sheet.divider = Divider::rope;
  Exposure exposure{camera_pose(view), {}, 0.003, {StoneLook{}}, {PersonLook{1.0, 9.0}}};
  exposure.velocity.linear = {0.0, 2.0, 0.0};
  cv::Mat first;
  SheetRenderer(view.lens, {0.006, 1.309}, rink, SensorModel{}, 5, 1).render(exposure, 11, first);
  for (const int threads : {1, 2, 3}) {
    cv::Mat again;
    SheetRenderer(view.lens, {0.006, 1.309}, rink, SensorModel{}, 5, threads).render(exposure, 11, again);
    EXPECT_EQ(cv::norm(first, again, cv::NORM_INF), 0.0) << threads;
  }
  cv::Mat other;
  SheetRenderer(view.lens, {0.006, 1.309}, rink, SensorModel{}, 5, 1).render(exposure, 12, other);
  EXPECT_GT(cv::norm(first, other, cv::NORM_INF), 0.0);
}

TEST(SheetRenderer, DrawsEveryDividerAndOddSizes) {
  for (const Divider divider : {Divider::line, Divider::bumper, Divider::rope, Divider::none}) {
    RinkAppearance rink;
    rink.sheet.divider = divider;
    Intrinsics lens = near_lens();
    lens.width_px = 801;
    lens.height_px = 603;
    lens.cx_px = 400.0;
    lens.cy_px = 300.0;
    const View view{"", lens, {0.2, 0.0, 2.0, 0.0, 28 * deg, 0.0}, {0.0, -3.4, 0.0}, 0.006};
    cv::Mat light;
    SheetRenderer(lens, {0.006, 1.309}, rink, SensorModel{}, 1)
        .render_light({camera_pose(view), {}, 0.0, {}, {}}, light);
    ASSERT_EQ(light.size(), cv::Size(801, 603));
    EXPECT_TRUE(cv::checkRange(light, true, nullptr, 0.0, 100.0));
  }
}

}  // namespace
}  // namespace hogline::hw::sim
