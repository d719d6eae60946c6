// Ten minutes of the control loop at 200 Hz over the kernel's interface, faster than they pass: the time is stepped,
// the frames are the kernel's. Wheels and head with the robot's own deadlines, their four drives, and somebody else's
// traffic, 40 % of 1 Mbit/s together. No machine's scheduler is judged: every cycle must be whole.
#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>

#include "hw/canopen/can_hub.hpp"
#include "hw/clock.hpp"
#include "src/steel/robot_bus.hpp"
#include "tests/hil/can_node.hpp"
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

constexpr Duration tick = 1ms;
constexpr double frame_s = 112e-6;  // eight bytes at 1 Mbit/s, with stuffing
constexpr int load_frames_per_s = 640;

// Four seconds, or as long as ./dev load asks.
Duration span_asked() {
  const char* seconds_asked = std::getenv("HOGLINE_LOAD_S");
  return std::chrono::seconds(seconds_asked == nullptr ? 4 : std::atoi(seconds_asked));
}

// The kernel's frames in the stepped time: what arrived since the last step arrived in it.
class SteppedBus final : public CanBus {
 public:
  SteppedBus(SocketCanBus& bus, const Clock& clock) : bus_(bus), clock_(clock) {}
  CanSendResult send(const CanFrame& frame) override { return bus_.send(frame); }
  std::optional<StampedCanFrame> receive() override {
    auto received = bus_.receive();
    if (received) received->stamp = clock_.now();
    return received;
  }
  bool up() const override { return bus_.up(); }
  bool error_passive() const override { return bus_.error_passive(); }

 private:
  SocketCanBus& bus_;
  const Clock& clock_;
};

class SteppedTap final : public CanTap {
 public:
  SteppedTap(LoadTally& tally, const Clock& clock) : tally_(tally), clock_(clock) {}
  void record(const CandumpRecord& record) override {
    CandumpRecord stepped = record;
    stepped.unix_time = std::chrono::duration_cast<std::chrono::microseconds>(clock_.now().time_since_epoch());
    tally_.record(stepped);
  }

 private:
  LoadTally& tally_;
  const Clock& clock_;
};

TwoAxisHeadConfig silent_head_config() {
  TwoAxisHeadConfig config = test::head_config();
  config.duties = {.sync = false, .heartbeat = false};
  return config;
}

// Both ends of one kernel interface, stepped together.
class SteppedRobot {
 public:
  explicit SteppedRobot(const std::string& interface)
      : kernel_(patient_bus(interface), now()),
        drives_kernel_({.interface = interface, .receive = robot_bus_config(interface, load_nodes, 127).own}, now()),
        stepped_(kernel_, clock_),
        drives_stepped_(drives_kernel_, clock_),
        hub_(stepped_),
        drives_hub_(drives_stepped_),
        stranger_(interface),
        wheels_(hub_.make_endpoint(), test::drive_config()),
        head_(hub_.make_endpoint(), silent_head_config()) {
    for (const std::uint8_t node : std::array<std::uint8_t, 2>{1, 2})
      devices_.emplace_back(drives_hub_.make_endpoint(), test::device_config(node));
    for (const std::uint8_t node : std::array<std::uint8_t, 2>{3, 4})
      devices_.emplace_back(drives_hub_.make_endpoint(), test::head_device_config(node));
    devices_[2].axis().slip_encoder(test::head_config().pan.zero_counts / 4096.0);
    devices_[3].axis().slip_encoder(test::head_config().tilt.zero_counts / 4096.0);
    kernel_.set_tap(&tap_);
  }

  bool run_until(const std::function<bool()>& done, Duration limit) {
    for (const Stamp end = clock_.now() + limit; clock_.now() < end; step()) {
      if (done()) return true;
    }
    return done();
  }
  bool both(DrivePhase phase) const { return hil::both(wheels_, head_, phase); }
  std::string why() const { return hil::why(wheels_, head_); }
  void enable() {
    wheels_.enable();
    head_.enable();
  }
  void begin_load() {
    tally_ = {};
    loading_ = true;
  }
  const LoadTally& tally() const { return tally_; }
  const SocketCanCounters& counters() const { return kernel_.state().counters; }
  std::uint64_t dropped() const {
    return kernel_.state().counters.kernel_drops + drives_kernel_.state().counters.kernel_drops;
  }

 private:
  void step() {
    clock_.advance(tick);
    if (loading_) send_load();
    if (++ticks_ % 5 == 0) control_period();
    drives_kernel_.step(clock_.now());
    for (std::size_t i = 0; i < devices_.size(); ++i) {
      const sim::AxisCommand command = devices_[i].step(clock_.now(), seconds(tick), speeds_[i]);
      speeds_[i] = command.power == sim::AxisPower::driven ? command.speed_radps : 0.0;
    }
    if (ticks_ % 100 == 0) static_cast<void>(stranger_.hear_all());
  }
  void control_period() {
    const Stamp present = clock_.now();
    kernel_.step(present);
    const double speed_radps = 5.0 + 4.0 * std::sin(seconds(present.time_since_epoch()));
    if (wheels_.state().phase == DrivePhase::enabled) wheels_.command({speed_radps, speed_radps}, present);
    if (head_.state().phase == DrivePhase::enabled) {
      head_.track({0.1 * std::cos(seconds(present.time_since_epoch())), 0.0}, present);
    }
    head_.step(present);  // the wheels' adapter sends SYNC, so it is the last
    wheels_.step(present);
  }
  void send_load() {
    for (owed_ += load_frames_per_s * seconds(tick); owed_ >= 1.0; owed_ -= 1.0)
      stranger_.send(0x7F0, {1, 2, 3, 4, 5, 6, 7, 8});
  }

  SteppedClock clock_{Stamp{1000s}};
  LoadTally tally_;
  SteppedTap tap_{tally_, clock_};
  SocketCanBus kernel_;
  SocketCanBus drives_kernel_;
  SteppedBus stepped_;
  SteppedBus drives_stepped_;
  CanHub hub_;
  CanHub drives_hub_;
  CanNode stranger_;
  TwoWheelDrive wheels_;
  TwoAxisHead head_;
  std::deque<sim::Cia402DriveDevice> devices_;
  std::array<double, 4> speeds_{};
  long ticks_ = 0;
  bool loading_ = false;
  double owed_ = 0.0;
};

class SteppedLoad : public VcanTest {};

TEST_F(SteppedLoad, FourDrivesAt200HzAndFortyPercentMissNoCycle) {
  run("ip link set " + name_ + " txqueuelen 1000");
  SteppedRobot robot(name_);
  ASSERT_TRUE(robot.run_until([&] { return robot.both(DrivePhase::ready); }, 20s)) << robot.why();
  robot.enable();
  ASSERT_TRUE(robot.run_until([&] { return robot.both(DrivePhase::enabled); }, 5s)) << robot.why();

  const Duration span = span_asked();
  const long cycles = span / 5ms;
  const long frames_before = frames_on(name_);
  const Stamp begin = now();
  robot.begin_load();
  robot.run_until([] { return false; }, span);
  const double frames_per_s = static_cast<double>(frames_on(name_) - frames_before) / seconds(span);
  const LoadTally& tally = robot.tally();

  std::printf(
      "| simulated | cycles of 5 ms | without all commands | missing feedback | dropped unread | bus load | passed in "
      "|\n|---|---|---|---|---|---|---|\n");
  std::printf("| %.0f s | %ld | %ld | %ld of %ld | %llu | %.0f %% | %.0f s |\n", seconds(span), tally.cycles(),
              tally.cycles_without_all_commands(), tally.missing_feedback(), 8 * tally.cycles(),
              static_cast<unsigned long long>(robot.dropped()), frames_per_s * frame_s * 100.0, seconds(now() - begin));

  EXPECT_TRUE(robot.both(DrivePhase::enabled)) << robot.why();
  EXPECT_EQ(tally.cycles(), cycles);
  EXPECT_EQ(tally.cycles_without_all_commands(), 0);
  EXPECT_LE(tally.missing_feedback(), 8) << "the last cycle's answers are not waited for";
  EXPECT_EQ(robot.dropped(), 0U);
  EXPECT_GE(frames_per_s * frame_s, 0.39);
  EXPECT_EQ(robot.counters().foreign, 0U);
  EXPECT_EQ(robot.counters().unconfirmed, 0U);
}

}  // namespace
