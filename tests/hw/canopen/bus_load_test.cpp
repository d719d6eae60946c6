// Four nodes and a strange load on one bus of 1 Mbit/s, for ten minutes: no cycle may be missed.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "hw/canopen/can_hub.hpp"
#include "hw/canopen/two_axis_head.hpp"
#include "tests/hw/canopen/drive_bench.hpp"
#include "tests/hw/canopen/head_bench.hpp"

namespace hogline::hw::test {
namespace {

constexpr std::array<std::uint32_t, 6> rpdos{0x201, 0x202, 0x203, 0x303, 0x204, 0x304};
constexpr std::array<std::uint32_t, 8> tpdos{0x181, 0x281, 0x182, 0x282, 0x183, 0x283, 0x184, 0x284};

/// Wheels and head on one bus through one hub, with drives that act each millisecond.
class RobotBus {
 public:
  RobotBus()
      : bus(clock, {.bit_rate_hz = 1e6}),
        hub(bus.make_endpoint()),
        stray(bus.make_endpoint()),
        drive(hub.make_endpoint(), drive_config()),
        head(hub.make_endpoint(), silent_head()) {
    for (const std::uint8_t node : std::array<std::uint8_t, 2>{1, 2})
      devices.emplace_back(bus.make_endpoint(), device_config(node));
    for (const std::uint8_t node : std::array<std::uint8_t, 2>{3, 4})
      devices.emplace_back(bus.make_endpoint(), head_device_config(node));
    devices[2].axis().slip_encoder(head_config().pan.zero_counts / 4096.0);
    devices[3].axis().slip_encoder(head_config().tilt.zero_counts / 4096.0);
  }

  void tick() {
    clock.advance(1ms);
    if (on_tick) on_tick();
    bus.deliver();
    if (++ticks % 5 == 0) {
      if (drive.state().phase == DrivePhase::enabled) {
        const double speed = 10.0 * std::sin(ticks * 1e-4);
        drive.command({speed, speed}, clock.now());
      }
      if (head.state().phase == DrivePhase::enabled) head.track({0.1 * std::cos(ticks * 1e-3), 0.0}, clock.now());
      head.step(clock.now());  // the wheels' adapter sends SYNC, so it is the last
      drive.step(clock.now());
    }
    for (std::size_t i = 0; i < devices.size(); ++i) {
      const sim::AxisCommand command = devices[i].step(clock.now(), 0.001, speeds[i]);
      speeds[i] = command.power == sim::AxisPower::driven ? command.speed_radps : 0.0;
    }
  }

  bool run_until(const std::function<bool()>& condition) {
    for (int i = 0; i < 5000; ++i, tick()) {
      if (condition()) return true;
    }
    return false;
  }

  bool both(DrivePhase phase) const { return drive.state().phase == phase && head.state().phase == phase; }

  SteppedClock clock{Stamp{1000s}};
  sim::VirtualCanBus bus;
  CanHub hub;
  CanBus& stray;
  TwoWheelDrive drive;
  TwoAxisHead head;
  std::deque<sim::Cia402DriveDevice> devices;
  std::array<double, 4> speeds{};
  std::function<void()> on_tick;
  int ticks = 0;

 private:
  static TwoAxisHeadConfig silent_head() {
    TwoAxisHeadConfig config = head_config();
    config.duties = {.sync = false, .heartbeat = false};
    return config;
  }
};

/// Each SYNC closes a cycle: with every RPDO sent before it, and every TPDO of the one before.
class CycleCounter {
 public:
  void operator()(const StampedCanFrame& seen) {
    wire_s += (47.0 + 8.0 * seen.frame.length + 0.1 * (34.0 + 8.0 * seen.frame.length)) * 1e-6;
    ++frames_[seen.frame.id];
    if (seen.frame.id == 0x181) feedback_ = seen.stamp;
    if (seen.frame.id == 0x201 && feedback_) latencies_us.push_back(static_cast<int>((seen.stamp - *feedback_) / 1us));
    if (seen.frame.id != 0x080) return;
    if (cycles++ > 0) {
      const auto once = [this](std::uint32_t id) { return frames_[id] == 1; };
      if (!std::all_of(rpdos.begin(), rpdos.end(), once)) ++without_command;
      if (!std::all_of(tpdos.begin(), tpdos.end(), once)) ++without_feedback;
    }
    frames_.clear();
  }

  int percentile_us(double p) {
    std::sort(latencies_us.begin(), latencies_us.end());
    return latencies_us.at(static_cast<std::size_t>(p * static_cast<double>(latencies_us.size() - 1)));
  }

  int cycles = 0;
  int without_command = 0;
  int without_feedback = 0;
  double wire_s = 0.0;
  std::vector<int> latencies_us;

 private:
  std::map<std::uint32_t, int> frames_;
  std::optional<Stamp> feedback_;
};

TEST(CanBusLoad, TenMinutesAtFortyPercentWithFourNodesMissNoCycle) {
  RobotBus robot;
  ASSERT_TRUE(robot.run_until([&] { return robot.both(DrivePhase::ready); }))
      << robot.drive.state().error.value_or(robot.head.state().error.value_or(DeviceError{})).what;
  robot.drive.enable();
  robot.head.enable();
  ASSERT_TRUE(robot.run_until([&] { return robot.both(DrivePhase::enabled); }));

  CycleCounter counter;
  robot.bus.set_tap([&counter](const StampedCanFrame& seen) { counter(seen); });
  // Somebody else's traffic, of higher and lower priority, in bursts of up to three frames.
  std::minstd_rand random(4);
  robot.on_tick = [&] {
    for (auto n = random() % 8; n >= 5; --n) {
      const auto id = static_cast<std::uint32_t>(random() % 2 ? 0x010 + random() % 0x60 : 0x620 + random() % 0x60);
      robot.stray.send({.id = id, .length = 8, .data = {0xA5}});
    }
  };
  for (int i = 0; i < 600'000; ++i) robot.tick();

  const double load = counter.wire_s / 600.0;
  std::printf("%d cycles, bus load %.1f %%; feedback on the bus to command on the bus: p50 %d us, p99 %d us\n",
              counter.cycles, 100.0 * load, counter.percentile_us(0.5), counter.percentile_us(0.99));
  EXPECT_TRUE(robot.both(DrivePhase::enabled))
      << robot.drive.state().error.value_or(robot.head.state().error.value_or(DeviceError{})).what;
  EXPECT_GT(load, 0.38);
  EXPECT_LT(load, 0.45);
  EXPECT_NEAR(counter.cycles, 600 * 200, 1);
  EXPECT_EQ(counter.without_command, 0);
  EXPECT_EQ(counter.without_feedback, 0);
  EXPECT_EQ(robot.hub.lost(), 0u);
  EXPECT_LT(counter.percentile_us(0.99), 5500) << "a command is one control period younger than its feedback";
}

TEST(CanHub, GivesEveryFrameToEachAndKeepsSendersApart) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock);
  CanHub hub(bus.make_endpoint());
  CanBus& a = hub.make_endpoint();
  CanBus& b = hub.make_endpoint();
  CanBus& other = bus.make_endpoint();
  other.send({.id = 0x181, .length = 1, .data = {1}});
  other.send({.id = 0x182, .length = 1, .data = {2}});
  bus.deliver();
  for (CanBus* endpoint : {&a, &b}) {
    EXPECT_EQ(endpoint->receive()->frame.id, 0x181u);
    EXPECT_EQ(endpoint->receive()->frame.id, 0x182u);
    EXPECT_FALSE(endpoint->receive());
  }
  a.send({.id = 0x201});
  bus.deliver();
  EXPECT_FALSE(b.receive()) << "what we say ourselves is no news";
  EXPECT_TRUE(other.receive());
  bus.set_up(false);
  EXPECT_FALSE(a.up());
  EXPECT_EQ(b.send({.id = 0x202}), CanSendResult::bus_down);
}

TEST(CanHub, AnEndpointThatNobodyReadsLosesTheNewestAndTheOthersNothing) {
  SteppedClock clock;
  sim::VirtualCanBus bus(clock);
  CanHub hub(bus.make_endpoint());
  CanBus& read = hub.make_endpoint();
  CanBus& unread = hub.make_endpoint();
  CanBus& other = bus.make_endpoint();
  for (std::size_t i = 0; i < CanHub::most_unread + 10; ++i) {
    other.send({.id = 0x181});
    bus.deliver();
    EXPECT_TRUE(read.receive());
  }
  EXPECT_EQ(hub.lost(), 10u);
  std::size_t kept = 0;
  while (unread.receive()) ++kept;
  EXPECT_EQ(kept, CanHub::most_unread);
}

}  // namespace
}  // namespace hogline::hw::test
