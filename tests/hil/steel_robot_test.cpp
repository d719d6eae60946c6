// A robot's devices opened as its rig file names them, on the kernel's own lines: drives on vcan, gripper and arm on
// TCP, gyro on a serial line, all of them in another program (`hogline rink`), and recorded pictures; and the thrower's
// own program beside it.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/steel/steel_robot.hpp"
#include "src/throwing/thrower_loop.hpp"
#include "tests/hil/drive_config.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/process.hpp"

using namespace hogline;
using namespace hogline::hil;

namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  ASSERT_NE(text.find(from), std::string::npos) << from;
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string kept(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
  return path;
}

// A folder of small pictures, no two alike: two a second for longer than the test takes.
std::string recording() {
  const std::filesystem::path folder = "/run/pictures";
  std::filesystem::create_directories(folder);
  for (int i = 0; i < 240; ++i) {
    cv::Mat picture(240, 320, CV_8UC3, cv::Scalar(90, 100, 110));
    cv::rectangle(picture, {10 + i, 60, 40, 80}, cv::Scalar(200, 180, 30), cv::FILLED);
    cv::imwrite(folder / (std::to_string(i) + ".png"), picture);
  }
  return folder;
}

// The practice rig on the lines of this machine; without a head, of which the rink has none.
std::string practice_rig_here() {
  std::string text{config::embedded_file("rigs/practice.yaml")};
  const auto head = text.find("\nhead:");
  text.erase(head, text.find("\nmodbus:") - head);
  for (const auto& [full, small] : {std::pair("width_px: 1600", "width_px: 320"),
                                    {"height_px: 1200", "height_px: 240"},
                                    {"cx_px: 803.2", "cx_px: 160"},
                                    {"cy_px: 596.4", "cy_px: 120"},
                                    {"cx_px: 795.7", "cx_px: 160"},
                                    {"cy_px: 604.1", "cy_px: 120"}}) {
    replace_all(text, full, small);
  }
  replace_all(text, "interface: can0", "interface: vcan0");
  replace_all(text, "port: 502", "port: 15502");
  replace_all(text, "/dev/serial/by-id/usb-GYRO", "/run/gyro");
  return text;
}

// ... as a rig of steel, and as the rink's, which nobody asks for pictures here.
std::string steel_rig() {
  std::string text = practice_rig_here();
  replace_all(text, "simulated: {}", "folder: {path: " + recording() + ", rate_hz: 2}");
  return text;
}

std::string rink_rig() {
  std::string text = practice_rig_here();
  for (const char* camera : {"hil-near", "hil-low"}) {
    const auto at = text.find("simulated: {}");
    text.replace(at, std::string("simulated: {}").size(), std::string("shared_memory: ") + camera);
  }
  return text;
}

// A test machine that stalls is no lost master.
std::string patient_scenario() {
  std::string text{config::embedded_file("scenarios/practice.yaml")};
  replace_all(text, "watchdog_s: 0.3", "watchdog_s: 5.0");
  return text;
}

// Stalls of the machine are no faults of the devices.
config::ThrowerRig patient(config::ThrowerRig rig) {
  rig.drive.timing = patient_drive_config().timing;
  rig.drive.timing.rpdo_timeout = 3s;
  rig.drive.plausibility.speed_error_time = 5s;
  rig.drive.plausibility.position_mismatch_rad = 100.0;
  rig.modbus.line.response_timeout = 2s;
  rig.gyro.silence_limit = 3s;
  rig.gyro.mode_deadline = 5s;
  for (Duration* limit :
       {&rig.gripper.jaws.silence_limit, &rig.gripper.jaws.echo_deadline, &rig.gripper.belt.silence_limit,
        &rig.gripper.belt.echo_deadline, &rig.arm.silence_limit, &rig.arm.echo_deadline, &rig.thrower.ages.gripper}) {
    *limit = 3s;
  }
  for (auto& [name, source] : rig.rig.sources) source.max_age = source.silence_limit = generous;
  return rig;
}

class SteelRobotTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(wait_until([] { return text_of("/run/rink.txt").find("ready") != std::string::npos; }))
        << "the rink does not start";
    rig_ = patient(config::parse_thrower_rig(steel_rig(), "steel.yaml"));
    robot_.emplace(*rig_, clock_);
  }

  // Control periods as the thrower's loop has them, until `done` holds.
  bool run_until(const std::function<bool()>& done, hw::WheelSpeeds speeds = {}) {
    return wait_until(
        [&] {
          const Stamp present = clock_.now();
          if (robot_->drive().state().phase == hw::DrivePhase::enabled) robot_->drive().command(speeds, present);
          robot_->drive().step(present);
          robot_->gripper().step(present);
          robot_->arm().step(present);
          robot_->gyro().step(present);
          if (rink_.running() && robot_->gyro().state().error)
            robot_->gyro().rearm();  // a machine that stalls reads unevenly
          if (robot_->near_camera().latest(present)) ++near_frames_;
          if (robot_->low_camera().latest(present)) ++low_frames_;
          return done();
        },
        generous, 5ms);
  }
  bool run_until(hw::DrivePhase phase) {
    return run_until([this, phase] { return robot_->drive().state().phase == phase; });
  }

  std::string errors() const {
    std::string text;
    for (const auto& error :
         {robot_->drive().state().error, robot_->gripper().state().error, robot_->arm().state().error,
          robot_->gyro().state().error, robot_->near_camera().error(), robot_->low_camera().error()}) {
      if (error) text += error->device + ": " + to_string(error->kind) + ": " + error->what + "\n";
    }
    return text;
  }

  Process rink_{{HOGLINE_PROGRAM, "rink", "--rig", kept("/run/rink.yaml", rink_rig()), "--scenario",
                 kept("/run/scenario.yaml", patient_scenario())},
                "/run/rink.txt"};
  hw::SteadyClock clock_;
  std::optional<config::ThrowerRig> rig_;
  mutable std::optional<SteelRobot> robot_;
  int near_frames_ = 0;
  int low_frames_ = 0;
};

TEST_F(SteelRobotTest, EveryPortIsServedByItsDeviceAndTellsWhenItIsGone) {
  ASSERT_TRUE(run_until(hw::DrivePhase::ready)) << errors();
  ASSERT_TRUE(run_until([&] {
    return robot_->gripper().state().jaws == hw::JawState::holding &&
           robot_->arm().state().position == hw::ArmPosition::folded && robot_->gyro().state().valid &&
           near_frames_ > 0 && low_frames_ > 0;
  })) << errors();
  EXPECT_EQ(errors(), "");

  robot_->drive().enable();
  ASSERT_TRUE(run_until(hw::DrivePhase::enabled)) << errors();
  ASSERT_TRUE(run_until([&] { return robot_->drive().state().measured.left_radps > 1.9; }, {2.0, 2.0})) << errors();
  robot_->drive().quick_stop();
  ASSERT_TRUE(run_until(hw::DrivePhase::stopped)) << errors();

  robot_->arm().unfold();
  robot_->gripper().spin(1.0);
  ASSERT_TRUE(run_until([&] { return robot_->arm().state().position == hw::ArmPosition::unfolded; })) << errors();
  EXPECT_GT(robot_->gripper().state().spin_radps, 0.8);
  robot_->gripper().release();
  ASSERT_TRUE(run_until([&] { return robot_->gripper().state().jaws == hw::JawState::open; })) << errors();
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(robot_->can_state()->counters.foreign, 0U);

  rink_.signal(SIGKILL);
  rink_.wait();
  ASSERT_TRUE(run_until([&] {
    return robot_->drive().state().error && robot_->gripper().state().error && robot_->arm().state().error &&
           robot_->gyro().state().error;
  })) << errors();
  EXPECT_EQ(robot_->drive().state().phase, hw::DrivePhase::faulted);
  EXPECT_FALSE(robot_->near_camera().error()) << "its pictures do not come from there";
  std::printf("%s", errors().c_str());
}

// Recorded pictures show no sheet here: the throw must end where it began, with everything said and nothing moved.
class SeesNothing final : public SheetSeer {
 public:
  SheetPosePercept near_view(const hw::Frame& frame) override { return nothing(frame); }
  SheetPosePercept low_view(const hw::Frame& frame, const vision::LowViewPrediction&) override {
    return nothing(frame);
  }

 private:
  static SheetPosePercept nothing(const hw::Frame& frame) {
    SheetPosePercept percept;
    percept.stamp = frame.stamp;
    percept.reason = "nothing to see";
    return percept;
  }
};

TEST_F(SteelRobotTest, TheThrowersOwnLoopRunsOnItAndEndsAThrowThatSeesNothing) {
  ASSERT_TRUE(run_until(hw::DrivePhase::ready)) << errors();
  ASSERT_TRUE(run_until([&] { return robot_->gripper().state().jaws == hw::JawState::holding; })) << errors();
  hw::HeldSwitch held;
  SeesNothing seer;
  ThrowerLoop loop(robot_->devices(held), ThrowerEyes(seer, rig_->looks),
                   servo::Thrower(rig_->thrower, {.speed_mps = 2.0, .spin_radps = 1.5}, clock_.now()),
                   servo::Supervisor(rig_->thrower));
  held.step(clock_.now());
  loop.arm(clock_.now());
  Stamp last = clock_.now();
  ASSERT_TRUE(wait_until(
      [&] {
        const Stamp present = clock_.now();
        held.step(present);
        loop.step(present, present - std::exchange(last, present));
        return loop.thrower().finished();
      },
      60s, 5ms));
  ASSERT_TRUE(loop.thrower().abort_reason());
  std::printf("ended: %s\n", loop.thrower().abort_reason()->c_str());
  EXPECT_FALSE(loop.thrower().released());
  EXPECT_EQ(robot_->gripper().state().jaws, hw::JawState::holding);
  EXPECT_LT(std::abs(robot_->drive().state().measured.left_radps), 0.05);
}

// The rig of `hogline thrower` with the kernel's bus in the place of datagrams; a kernel within a kernel is given time.
std::string thrower_rig() {
  std::string text = text_of(std::string(HOGLINE_SOURCE_DIR) + "/config/rigs/thrower.yaml");
  const auto bus = text.find("can: {udp_multicast");
  text.replace(bus, text.find('\n', bus) - bus, "can: {interface: vcan0}");
  for (const auto& [tight, wide] : {std::pair("/tmp/hogline-thrower-gyro", "/run/thrower-gyro"),
                                    {"/tmp/hogline-thrower-operator", "/run/thrower-operator"},
                                    {"command_age_limit_s: 0.060", "command_age_limit_s: 1.0"},
                                    {"feedback_timeout_s: 0.080", "feedback_timeout_s: 2.0"},
                                    {"rpdo_timeout_s: 0.100", "rpdo_timeout_s: 2.0"},
                                    {"heartbeat_timeout_s: 0.300", "heartbeat_timeout_s: 2.0"},
                                    {"sdo_timeout_s: 0.100", "sdo_timeout_s: 2.0"},
                                    {"boot_timeout_s: 5.0", "boot_timeout_s: 20.0"},
                                    {"response_timeout_s: 0.2", "response_timeout_s: 1.0"},
                                    {"silence_limit_s: 0.1 ", "silence_limit_s: 1.0 "},
                                    {"silence_limit_s: 0.25", "silence_limit_s: 2.0"},
                                    {"silence_limit_s: 0.4", "silence_limit_s: 2.0"},
                                    {"operator_age_s: 0.5", "operator_age_s: 2.0"}}) {
    replace_all(text, tight, wide);
  }
  return text;
}

TEST(ThrowerProgram, ArmsOnTheKernelsBusWithTheRinksProgramBehindIt) {
  const std::string rig = kept("/run/thrower.yaml", thrower_rig());
  Process rink({HOGLINE_PROGRAM, "rink", "--rig", rig, "--scenario", kept("/run/scenario.yaml", patient_scenario())},
               "/run/thrower-rink.txt");
  const auto tells = [](const char* who, const char* event) {
    return text_of(std::string("/run/") + who + ".txt").find(std::string("\"event\":\"") + event) != std::string::npos;
  };
  ASSERT_TRUE(wait_until([&] { return tells("thrower-rink", "ready"); }));
  // It is loaded before the thrower runs first, on the only processor, and stopped until it is wanted.
  Process hand({HOGLINE_PROGRAM, "hold", "--rig", rig}, "/run/operator.txt");
  ASSERT_TRUE(wait_until([&] { return tells("operator", "nobody listens"); }, 60s));
  hand.signal(SIGSTOP);
  Process thrower({HOGLINE_PROGRAM, "thrower", "--rig", rig}, "/run/thrower.txt");
  std::string skip_rig = thrower_rig();
  replace_all(skip_rig, "robot: thrower", "robot: skip");
  replace_all(skip_rig, "peers: [skip]", "peers: [thrower]");
  Process skip({HOGLINE_PROGRAM, "link", "--rig", kept("/run/skip.yaml", skip_rig), "--seconds", "120"},
               "/run/skip.txt");
  const auto well = [&] {
    return text_of("/run/thrower.txt").find("the operator's switch is not held") != std::string::npos;
  };
  ASSERT_TRUE(wait_until(well, 60s)) << text_of("/run/thrower.txt");
  hand.signal(SIGCONT);
  EXPECT_TRUE(wait_until([&] { return tells("thrower", "armed"); }, 60s)) << text_of("/run/thrower.txt");
  thrower.signal(SIGTERM);
  EXPECT_EQ(thrower.wait(), 0);
  std::printf("%s", text_of("/run/thrower.txt").c_str());
}

TEST(SteelRobotConfig, RefusesARigOfTheSimulatedRink) {
  const config::ThrowerRig rig = config::parse_thrower_rig(config::embedded_file("rigs/practice.yaml"), "practice");
  const hw::SteadyClock clock;
  try {
    const SteelRobot robot(rig, clock);
    FAIL();
  } catch (const config::ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("cameras.near.source"), std::string::npos) << e.what();
  }
}

}  // namespace
