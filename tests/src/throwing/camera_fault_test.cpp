// Each fault of the low camera, as the robot's controller meets it: a device error within its deadline, and it stays.
#include <gtest/gtest.h>

#include "src/config/embedded.hpp"
#include "src/config/scenario.hpp"
#include "src/throwing/fault.hpp"

namespace hogline {
namespace {

using namespace std::chrono_literals;

constexpr Duration period = 5ms;

// Pictures of a twenty-fifth of the size: nobody looks for lines here.
config::ThrowerRig small_rig() {
  config::ThrowerRig rig = config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice rig");
  for (auto* camera : {&*rig.rig.near_camera, &*rig.rig.low_camera}) {
    auto& lens = camera->intrinsics;
    lens.width_px /= 5;
    lens.height_px /= 5;
    for (double* length : {&lens.fx_px, &lens.fy_px, &lens.cx_px, &lens.cy_px}) *length /= 5.0;
  }
  return rig;
}

struct Case {
  const char* fault;
  hw::DeviceErrorKind kind;
  const char* says;
  Duration within;  ///< one frame and its latency are up to 40 ms
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.fault; }

class CameraFaults : public testing::TestWithParam<Case> {};

TEST_P(CameraFaults, are_device_errors_within_their_deadline_and_stay) {
  const Case& c = GetParam();
  SimulatedRobot robot(
      small_rig(), config::parse_scenario(config::embedded_file("scenarios/practice.yaml"), "practice scenario", 1));
  hw::Camera& camera = robot.devices().low_camera;
  const auto run = [&](Duration span) {
    int frames = 0;
    for (const Stamp end = robot.rink().now() + span; robot.rink().now() < end && !camera.error();) {
      robot.rink().step(period);
      frames += camera.latest(robot.rink().now()) ? 1 : 0;
    }
    return frames;
  };
  EXPECT_GE(run(500ms), 25);
  ASSERT_FALSE(camera.error()) << camera.error()->what;

  const auto fault = parse_fault(std::string(c.fault) + "@0");
  ASSERT_TRUE(fault);
  inject(fault->kind, robot);
  const Stamp struck = robot.rink().now();
  run(1s);
  ASSERT_TRUE(camera.error());
  EXPECT_EQ(camera.error()->kind, c.kind) << camera.error()->what;
  EXPECT_EQ(camera.error()->device, "low camera");
  EXPECT_NE(camera.error()->what.find(c.says), std::string::npos) << camera.error()->what;
  EXPECT_LE(seconds(robot.rink().now() - struck), seconds(c.within));
  RecordProperty("detected_after_ms", std::to_string(1e3 * seconds(robot.rink().now() - struck)));

  robot.low_camera().inject(hw::sim::RenderedCamera::Fault::none);
  for (int k = 0; k < 100; ++k) {
    robot.rink().step(period);
    camera.latest(robot.rink().now());
  }
  EXPECT_TRUE(camera.error()) << "good frames do not clear it";
  camera.rearm();
  EXPECT_FALSE(camera.error());
}

using hw::DeviceErrorKind;
INSTANTIATE_TEST_SUITE_P(Table, CameraFaults,
                         testing::Values(Case{"camera-black", DeviceErrorKind::implausible, "black", 45ms},
                                         Case{"camera-saturated", DeviceErrorKind::implausible, "saturated", 45ms},
                                         Case{"camera-freeze", DeviceErrorKind::implausible, "repeats itself", 45ms},
                                         Case{"camera-repeats", DeviceErrorKind::implausible, "frozen", 45ms},
                                         Case{"camera-time-back", DeviceErrorKind::implausible, "before the last one's",
                                              45ms},
                                         Case{"camera-late", DeviceErrorKind::timeout, "after its exposure", 160ms},
                                         Case{"camera-stops", DeviceErrorKind::timeout, "no frame", 190ms}));

}  // namespace
}  // namespace hogline
