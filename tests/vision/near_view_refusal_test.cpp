// Pictures that look like a sheet and are none that the robot stands before: never a pose.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tests/support/random_scene.hpp"
#include "vision/geometry/sheet_camera.hpp"
#include "vision/near_view.hpp"

namespace hogline::vision {
namespace {

using hogline::testing::RandomScene;
using hogline::testing::SceneMix;

constexpr double degree = std::numbers::pi / 180.0;
const SceneMix empty_ice{.most_stones = 0, .most_people = 0};

// A scene with painted sidelines and nothing on the ice.
RandomScene plain_scene() {
  RandomScene scene = hogline::testing::random_scene(5, empty_ice);
  scene.rink.sheet.divider = hw::sim::Divider::line;
  scene.rink.sheet.neighbours = true;
  scene.rink.sheet.logos.clear();
  scene.setup.sheet.sideline = SidelineKind::line;
  return scene;
}

cv::Mat seen_from(RandomScene scene, const PlanarPose& body) {
  scene.exposure.eMc = eMb(body) * bMc(scene.true_mount);
  return render(scene, empty_ice);
}

cv::Mat far_end_from_behind(RandomScene scene) { return seen_from(scene, {0.2, 3.4, std::numbers::pi + 0.05}); }

cv::Mat from_mid_sheet(RandomScene scene) { return seen_from(scene, {0.1, 14.0, 0.02}); }

cv::Mat between_two_sheets(RandomScene scene) { return seen_from(scene, {2.45, -3.4, 0.01}); }

cv::Mat across_the_sheets(RandomScene scene) { return seen_from(scene, {-2.0, 0.5, -90.0 * degree}); }

cv::Mat from_a_balcony(RandomScene scene) {
  Mount high = scene.true_mount;
  high.z_m = 5.5;
  high.pitch_rad = 35.0 * degree;
  scene.exposure.eMc =
      eMb({0.0, -6.5, 0.0}) * bMc(high) * Pose(Eigen::AngleAxisd(90.0 * degree, Eigen::Vector3d::UnitZ()));
  return render(scene, empty_ice);
}

cv::Mat upright_balcony(RandomScene scene) {
  Mount high = scene.true_mount;
  high.z_m = 5.5;
  scene.exposure.eMc = eMb({0.0, -6.0, 0.0}) * bMc(high);
  return render(scene, empty_ice);
}

// Rings alone, painted where the scene's would be seen.
cv::Mat rings_without_lines(RandomScene scene) {
  const Lens lens(scene.setup.intrinsics);
  const SheetCamera camera(lens, scene.eMc, scene.setup.ice);
  cv::Mat picture(1200, 1600, CV_8UC3, cv::Scalar::all(205));
  const cv::Scalar colours[4] = {{150, 40, 20}, {205, 205, 205}, {30, 30, 170}, {205, 205, 205}};
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<cv::Point> outline;
    for (int i = 0; i < 360; ++i) {
      const Eigen::Vector2d p = rules::ring_radii_m[k] * Eigen::Vector2d(std::cos(i * degree), std::sin(i * degree));
      const auto pixel = camera.project_paint(p);
      if (pixel) outline.emplace_back(static_cast<int>(16.0 * pixel->x()), static_cast<int>(16.0 * pixel->y()));
    }
    cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{outline}, colours[k], cv::LINE_AA, 4);
  }
  cv::GaussianBlur(picture, picture, {0, 0}, 0.7);
  return picture;
}

// Half the lines are worn off: the rings' cross is there, back line and hog line are not.
cv::Mat cross_without_back_and_hog(RandomScene scene) {
  scene.rink.sheet.thin_lines = scene.rink.sheet.hog_line = scene.rink.sheet.ice;
  scene.rink.sheet.divider = hw::sim::Divider::none;
  scene.rink.sheet.courtesy_lines = scene.rink.sheet.hacks = false;
  return render(scene, empty_ice);
}

cv::Mat lines_without_rings(RandomScene scene) {
  scene.rink.sheet.rings.fill(scene.rink.sheet.ice);
  return render(scene, empty_ice);
}

cv::Mat bare_ice(RandomScene scene) {
  auto& sheet = scene.rink.sheet;
  sheet.rings.fill(sheet.ice);
  sheet.thin_lines = sheet.hog_line = sheet.divider_colour = sheet.ice;
  sheet.hacks = false;
  return render(scene, empty_ice);
}

// A person right before the lens.
cv::Mat hidden_by_a_coat(RandomScene scene) {
  scene.exposure.people.push_back({.x_m = scene.body.x_m, .y_m = scene.body.y_m + 0.75, .height_m = 2.4});
  cv::Mat picture = render(scene, empty_ice);
  cv::rectangle(picture, {150, 0, 1300, 1200}, cv::Scalar(60, 40, 30), cv::FILLED);
  return picture;
}

// A photograph of a sheet hung on a wall, seen at an angle.
cv::Mat poster(RandomScene scene) {
  const cv::Mat photograph = render(scene, empty_ice);
  const cv::Point2f from[4] = {{0, 0}, {1600, 0}, {1600, 1200}, {0, 1200}};
  const cv::Point2f to[4] = {{420, 260}, {1180, 330}, {1150, 820}, {430, 900}};
  cv::Mat wall(1200, 1600, CV_8UC3, cv::Scalar(150, 160, 165));
  cv::warpPerspective(photograph, wall, cv::getPerspectiveTransform(from, to), wall.size(), cv::INTER_LINEAR,
                      cv::BORDER_TRANSPARENT);
  return wall;
}

cv::Mat house_on_a_wall(const RandomScene&) {
  cv::Mat wall(1200, 1600, CV_8UC3, cv::Scalar::all(200));
  const double scale = 300.0;
  const cv::Point centre(800, 640);
  const cv::Scalar colours[4] = {{150, 40, 20}, {225, 225, 225}, {30, 30, 170}, {225, 225, 225}};
  for (int k = 0; k < 4; ++k) {
    const double radius = rules::ring_radii_m[static_cast<std::size_t>(k)];
    cv::circle(wall, centre, static_cast<int>(scale * radius), colours[k], cv::FILLED, cv::LINE_AA);
  }
  cv::line(wall, {0, 640}, {1600, 640}, cv::Scalar::all(20), 4, cv::LINE_AA);
  cv::line(wall, {800, 0}, {800, 1200}, cv::Scalar::all(20), 4, cv::LINE_AA);
  return wall;
}

cv::Mat upside_down(RandomScene scene) {
  cv::Mat picture = render(scene, empty_ice);
  cv::flip(picture, picture, 0);
  return picture;
}

struct NoSheet {
  const char* description;
  std::function<cv::Mat(RandomScene)> picture;
};

void PrintTo(const NoSheet& c, std::ostream* out) { *out << c.description; }

class NearViewDoubts : public ::testing::TestWithParam<NoSheet> {};

TEST_P(NearViewDoubts, WhatIsNoSheetBeforeTheRobot) {
  const RandomScene scene = plain_scene();
  NearView near(scene.setup);
  ASSERT_TRUE(near.acquire(render(scene, empty_ice), {}).ok) << "the scene itself";
  const SheetPosePercept p = near.acquire(GetParam().picture(scene), {});
  EXPECT_FALSE(p.ok) << "x " << p.body.x_m << " y " << p.body.y_m << " yaw " << p.body.yaw_rad / degree << " deg, "
                     << p.sites_used << " of " << p.sites_tried << " sites";
  EXPECT_FALSE(p.reason.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Pictures, NearViewDoubts,
    ::testing::Values(
        NoSheet{"the house from its other side", far_end_from_behind},
        NoSheet{"down the sheet from its middle", from_mid_sheet}, NoSheet{"between two sheets", between_two_sheets},
        NoSheet{"across the sheets", across_the_sheets}, NoSheet{"from a balcony, on its side", from_a_balcony},
        NoSheet{"from a balcony", upright_balcony}, NoSheet{"rings without lines", rings_without_lines},
        NoSheet{"a cross in the rings and no other line", cross_without_back_and_hog},
        NoSheet{"lines without rings", lines_without_rings}, NoSheet{"bare ice", bare_ice},
        NoSheet{"a coat before the lens", hidden_by_a_coat}, NoSheet{"a poster of a sheet", poster},
        NoSheet{"a house painted on a wall", house_on_a_wall}, NoSheet{"mirrored top to bottom", upside_down}));

}  // namespace
}  // namespace hogline::vision
