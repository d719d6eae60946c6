// The cameras on the simulated robot.
#include "hw/sim/rink_cameras.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "tests/hw/sim/reference_scenario.hpp"
#include "tests/hw/sim/reference_wheels.hpp"
#include "vision/geometry/ice.hpp"
#include "vision/geometry/lens.hpp"

namespace hogline::hw::sim {
namespace {

using namespace std::chrono_literals;

Scenario seen_scenario() {
  auto scenario = exact_scenario();
  scenario.sheet = {.width_m = 4.7,
                    .sideline = SidelineKind::line,
                    .sideline_width_m = 0.04,
                    .paint_depth_m = 0.008,
                    .refractive_index = 1.309,
                    .rings = {{{0.03, 0.1, 0.4}, {0.8, 0.8, 0.8}, {0.5, 0.04, 0.05}, {0.8, 0.8, 0.8}}},
                    .ice = {0.8, 0.8, 0.8},
                    .hog_line = {0.05, 0.05, 0.05},
                    .thin_lines = {0.03, 0.03, 0.03},
                    .sideline_colour = {0.03, 0.03, 0.03}};
  scenario.light = {.level = 0.75};
  scenario.near_camera = scenario.low_camera = {.rate_hz = 60.0,
                                                .exposure_s = 0.003,
                                                .latency_s = 0.014,
                                                .latency_jitter_s = 0.001,
                                                .electrons_full_scale = 9000.0,
                                                .read_noise_electrons = 8.0,
                                                .pitch_error_rad = 0.002};
  scenario.robot.start_y_m = 3.4;
  scenario.robot.start_yaw_rad = 0.02;
  scenario.drive = {.bandwidth_hz = 15.0, .dead_time_s = 0.005};
  scenario.arm.unfolded_at_start = false;
  return scenario;
}

CameraRig low_rig() {
  return {.intrinsics = {.width_px = 400,
                         .height_px = 300,
                         .fx_px = 175.0,
                         .fy_px = 175.0,
                         .cx_px = 199.0,
                         .cy_px = 151.0,
                         .distortion = {-0.1, 0.01, 0.0, 0.0, 0.0}},
          .mount = {.x_m = 0.45, .z_m = 0.5, .pitch_rad = 0.35},
          .gamma = 1.0};
}

Rink rink_of(const Scenario& scenario) {
  return Rink({.scenario = scenario, .left = wheel_rig(1, 1), .right = wheel_rig(2, -1), .bus = {}}, Stamp{} + 1s);
}

void run(Rink& rink, Duration span) {
  for (const Stamp end = rink.now() + span; rink.now() < end;) rink.step(5ms);
}

TEST(RinkCameras, the_hog_line_is_where_truth_lens_and_ice_put_it) {
  const auto scenario = seen_scenario();
  auto rink = rink_of(scenario);
  auto camera = low_camera(rink, scenario, low_rig(), 1);
  run(rink, 100ms);
  const auto frame = camera.latest(rink.now());
  ASSERT_TRUE(frame);

  auto mount = low_rig().mount;
  mount.pitch_rad += scenario.low_camera.pitch_error_rad;
  const vision::Pose eMc = vision::eMb(rink.truth().body) * vision::bMc(mount);
  const vision::Ice ice{scenario.sheet.paint_depth_m, scenario.sheet.refractive_index};
  const auto surface = vision::surface_point({0.5, 6.401 + 0.0508}, eMc.translation(), ice);
  const auto pixel =
      vision::Lens(low_rig().intrinsics).project(eMc.inverse() * Eigen::Vector3d(surface.xy.x(), surface.xy.y(), 0.0));
  ASSERT_TRUE(pixel);
  const auto level = [&](double dv) {
    return frame->bgr.at<cv::Vec3b>(static_cast<int>(std::lround(pixel->y() + dv)),
                                    static_cast<int>(std::lround(pixel->x())))[1];
  };
  EXPECT_LT(level(0.0), 0.6 * level(8.0)) << "the line against the ice before it";
  EXPECT_LT(level(0.0), 0.6 * level(-8.0)) << "and behind it";
}

TEST(RinkCameras, a_frame_carries_the_moment_of_its_exposure_and_arrives_late) {
  const auto scenario = seen_scenario();
  auto rink = rink_of(scenario);
  auto camera = low_camera(rink, scenario, low_rig(), 1);
  run(rink, 100ms);
  const auto frame = camera.latest(rink.now());
  ASSERT_TRUE(frame);
  const double age_s = seconds(rink.now() - frame->stamp);
  EXPECT_GE(age_s, 0.011);
  EXPECT_LE(age_s, 0.017 + 1.0 / 60.0);
  EXPECT_FALSE(camera.latest(rink.now())) << "never the same frame twice";
}

TEST(RinkCameras, the_near_camera_sees_darkness_unless_the_arm_is_unfolded) {
  for (const bool unfolded : {false, true}) {
    auto scenario = seen_scenario();
    scenario.arm.unfolded_at_start = unfolded;
    auto rink = rink_of(scenario);
    auto rig = low_rig();
    rig.mount.z_m = 2.0;
    auto camera = near_camera(rink, scenario, rig, 1);
    run(rink, 100ms);
    const auto frame = camera.latest(rink.now());
    ASSERT_TRUE(frame);
    EXPECT_EQ(cv::mean(frame->bgr)[1] > 50.0, unfolded);
  }
}

TEST(RinkCameras, the_same_seed_gives_the_same_pictures) {
  const auto picture = [](std::uint64_t seed) {
    auto scenario = seen_scenario();
    scenario.seed = seed;
    auto rink = rink_of(scenario);
    auto camera = low_camera(rink, scenario, low_rig(), 2);
    run(rink, 100ms);
    return camera.latest(rink.now())->bgr;
  };
  const cv::Mat first = picture(1);
  EXPECT_EQ(cv::norm(first, picture(1), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(first, picture(2), cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace hogline::hw::sim
