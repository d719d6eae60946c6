// The control loop at 200 Hz in real time over the kernel's interface: wheels and head, their four drives in a thread
// of their own, and somebody else's traffic up to 40 % of 1 Mbit/s. Cycles are counted; the clock is only reported,
// because the guest has one processor and the host's scheduler above it. stepped_load_test.cpp goes on for longer.
#include <array>
#include <atomic>
#include <csignal>
#include <deque>
#include <sstream>
#include <thread>

#include "hw/canopen/can_hub.hpp"
#include "src/steel/robot_bus.hpp"
#include "tests/hil/hil.hpp"
#include "tests/hil/load_robot.hpp"
#include "tests/hil/load_tally.hpp"
#include "tests/hil/process.hpp"
#include "tests/hw/canopen/drive_bench.hpp"
#include "tests/hw/canopen/head_bench.hpp"

using namespace hogline;
using namespace hogline::hw;
using namespace hogline::hil;
namespace test = hogline::hw::test;

namespace {

constexpr int periods = 1200;  // 6 s on a machine that has the time

// Stalls of the machine are no faults of the bus.
DriveTiming patient() {
  return {.command_age_limit = 10s,
          .feedback_timeout = generous,
          .rpdo_timeout = generous,
          .heartbeat_timeout = generous,
          .sdo_timeout = 5s,
          .boot_timeout = generous,
          .state_timeout = 10s,
          .quick_stop_timeout = 1s,
          .stop_margin = 5s};
}
constexpr DrivePlausibility lenient{
    .standstill_radps = 0.2, .speed_error_radps = 20.0, .speed_error_time = generous, .position_mismatch_rad = 1e3};

// What the standards' four drives do, as far as a shared processor lets them: each millisecond.
class Drives {
 public:
  explicit Drives(const std::string& interface)
      : bus_({.interface = interface, .receive = heard_by_nodes()}, now()), hub_(bus_) {
    for (const std::uint8_t node : std::array<std::uint8_t, 2>{1, 2})
      devices_.emplace_back(hub_.make_endpoint(), test::device_config(node));
    for (const std::uint8_t node : std::array<std::uint8_t, 2>{3, 4})
      devices_.emplace_back(hub_.make_endpoint(), test::head_device_config(node));
    thread_ = std::thread([this] { live(); });
  }
  ~Drives() { end(); }

  // Ends the thread; then the counters may be read.
  const SocketCanCounters& end() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    return bus_.state().counters;
  }

 private:
  static std::vector<CanFilter> heard_by_nodes() {
    return robot_bus_config("", load_nodes, 127).own;  // what the master says
  }

  void live() {
    std::array<double, 4> speeds{};
    for (Stamp last = now(); !stop_; std::this_thread::sleep_for(1ms)) {
      const Stamp present = now();
      const double dt_s = seconds(present - last);
      last = present;
      bus_.step(present);
      for (std::size_t i = 0; i < devices_.size(); ++i) {
        const sim::AxisCommand command = devices_[i].step(present, dt_s, speeds[i]);
        speeds[i] = command.power == sim::AxisPower::driven ? command.speed_radps : 0.0;
      }
    }
  }

  SocketCanBus bus_;
  CanHub hub_;
  std::deque<sim::Cia402DriveDevice> devices_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

TwoWheelDriveConfig wheels_config() {
  TwoWheelDriveConfig config = test::drive_config();
  config.timing = patient();
  config.plausibility = lenient;
  return config;
}

TwoAxisHeadConfig silent_head_config() {
  TwoAxisHeadConfig config = test::head_config();
  config.timing = patient();
  config.duties = {.sync = false, .heartbeat = false};
  config.plausibility = lenient;
  return config;
}

// The robot's side of the bus.
struct Robot {
  explicit Robot(const std::string& interface)
      : bus(patient_bus(interface), now()),
        hub(bus),
        wheels(hub.make_endpoint(), wheels_config()),
        head(hub.make_endpoint(), silent_head_config()) {}

  void control_period() {
    const Stamp present = now();
    bus.step(present);
    if (wheels.state().phase == DrivePhase::enabled) wheels.command({5.0, 5.0}, present);
    if (head.state().phase == DrivePhase::enabled) head.track({0.05, 0.0}, present);
    head.step(present);  // the wheels' adapter sends SYNC, so it is the last
    wheels.step(present);
  }

  // At 200 Hz until `done`; a period that begins one period late or more is a stall, and the rhythm starts anew.
  bool run_until(const std::function<bool()>& done, Duration limit) {
    const Stamp end = now() + limit;
    for (Stamp due = now(); now() < end; due += 5ms) {
      if (now() > due + 5ms) {
        ++stalls;
        due = now();
      }
      std::this_thread::sleep_until(due);
      control_period();
      if (done()) return true;
    }
    return done();
  }

  bool both(DrivePhase phase) const { return hil::both(wheels, head, phase); }
  std::string why() const { return hil::why(wheels, head); }

  SocketCanBus bus;
  CanHub hub;
  TwoWheelDrive wheels;
  TwoAxisHead head;
  int stalls = 0;
};

// A row of doc/performance.md, and the histogram.
void print(const LoadTally& tally, int stalls, double frames_per_s, std::uint64_t dropped) {
  std::printf(
      "| cycles of 5 ms | stalled by the scheduler | without all commands | missing feedback | dropped unread | "
      "bus load | p50 | p99 | longest |\n|---|---|---|---|---|---|---|---|---|\n");
  std::printf("| %ld | %d | %ld | %ld of %ld | %llu | %.0f %% | %.1f ms | %.1f ms | %.0f ms |\n", tally.cycles(),
              stalls, tally.cycles_without_all_commands(), tally.missing_feedback(), 8 * tally.cycles(),
              static_cast<unsigned long long>(dropped), frames_per_s * 112e-6 * 100.0, tally.latency_ms(0.5),
              tally.latency_ms(0.99), tally.longest_latency_ms());
  std::printf("\n    feedback on the bus to command on the bus\n");
  std::istringstream lines(tally.histogram());
  for (std::string line; std::getline(lines, line);) std::printf("  %s\n", line.c_str());
}

class BusLoad : public VcanTest {};

TEST_F(BusLoad, FourDrivesAt200HzAndFortyPercentMissNoCycle) {
  run("ip link set " + name_ + " txqueuelen 1000");
  Drives drives(name_);
  Robot robot(name_);
  ASSERT_TRUE(robot.run_until([&] { return robot.both(DrivePhase::ready); }, generous)) << robot.why();
  robot.wheels.enable();
  robot.head.enable();
  ASSERT_TRUE(robot.run_until([&] { return robot.both(DrivePhase::enabled); }, generous)) << robot.why();

  Process load({"cangen", name_, "-g", "1.1", "-I", "7F0", "-L", "8", "-i"});
  LoadTally tally;
  robot.bus.set_tap(&tally);
  robot.stalls = 0;
  const long frames_before = frames_on(name_);
  const Stamp start = now();
  int count = 0;
  ASSERT_TRUE(robot.run_until([&] { return ++count >= periods; }, periods * 100ms))
      << "the machine is too busy to say anything";
  const double frames_per_s = static_cast<double>(frames_on(name_) - frames_before) / seconds(now() - start);
  load.signal(SIGTERM);
  robot.bus.set_tap(nullptr);
  EXPECT_TRUE(robot.both(DrivePhase::enabled)) << robot.why();
  const SocketCanCounters drive_counters = drives.end();
  const std::uint64_t dropped = robot.bus.state().counters.kernel_drops + drive_counters.kernel_drops;
  print(tally, robot.stalls, frames_per_s, dropped);

  EXPECT_NEAR(static_cast<double>(tally.cycles()), periods, 2.0);
  EXPECT_EQ(tally.cycles_without_all_commands(), 0);
  EXPECT_GT(tally.latency_ms(0.5), 0.0);
  const long unanswered = 2 * 8;  // the last cycles' answers are not waited for
  EXPECT_TRUE(robot.stalls > 0 || tally.missing_feedback() <= unanswered) << tally.missing_feedback();
  EXPECT_EQ(robot.bus.state().counters.foreign, 0U);
  EXPECT_EQ(robot.bus.state().counters.unconfirmed, 0U);
}

}  // namespace
