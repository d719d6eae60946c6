// The simulated drive by raw objects: the state machine, ramps, speed loop and encoder.
#include "hw/sim/cia402_drive_device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hw/sim/virtual_can_bus.hpp"
#include "tests/hw/can_text.hpp"

namespace hogline::hw::test {
namespace {

using namespace std::chrono_literals;

constexpr double two_pi = 2.0 * std::numbers::pi;

class DriveDeviceTest : public testing::Test {
 protected:
  static sim::Cia402DriveConfig config() {
    return {.identity = {.node = 5, .device_type = 0x00020192, .name = "D"},
            .axis = {.bandwidth_radps = 100.0,
                     .dead_time_s = 0.003,
                     .encoder_counts_per_rev = 4096.0,
                     .velocity_window_s = 0.004},
            .position_counts_per_rev = 4096.0,
            .velocity_units_per_rps = 1000.0,
            .acceleration_units_per_rps2 = 1000.0,
            .switch_on_time_s = 0.02};
  }

  void run(Duration span) {
    for (Duration t{0}; t < span; t += 1ms) {
      clock.advance(1ms);
      command = drive.step(clock.now(), 0.001, axis_radps);
      if (command.power == sim::AxisPower::driven) axis_radps = command.speed_radps;
    }
  }

  /// As an SDO or PDO write from the bus would.
  std::uint32_t write(std::uint16_t index, std::int64_t value, std::size_t size) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>((value >> (8 * i)) & 0xFF));
    return drive.communication().objects().write(index, 0, bytes);
  }

  void control(std::uint16_t word, Duration span = 5ms) {
    ASSERT_EQ(write(0x6040, word, 2), 0u);
    run(span);
  }

  std::uint16_t state() const { return static_cast<std::uint16_t>(drive.communication().objects().get(0x6041) & 0x6F); }

  void enable() {
    run(50ms);
    ASSERT_EQ(write(0x6060, 9, 1), 0u);
    for (const std::uint16_t word : {std::uint16_t{0x06}, std::uint16_t{0x07}}) control(word);
    control(0x0F, 30ms);
    ASSERT_EQ(state(), 0x27);
  }

  double rps() const { return axis_radps / two_pi; }

  SteppedClock clock{Stamp{10s}};
  sim::VirtualCanBus bus{clock};
  sim::Cia402DriveDevice drive{bus.make_endpoint(), config()};
  sim::AxisCommand command;
  double axis_radps = 0.0;
};

TEST_F(DriveDeviceTest, WalksThroughTheStatesOneCommandEach) {
  run(50ms);
  EXPECT_EQ(state(), 0x40);
  control(0x0F);
  EXPECT_EQ(state(), 0x40) << "enable has no meaning here";
  control(0x06);
  EXPECT_EQ(state(), 0x21);
  control(0x07);
  EXPECT_EQ(state(), 0x23);
  control(0x0F, 5ms);
  EXPECT_EQ(state(), 0x23) << "switching on takes its time";
  control(0x0F, 20ms);
  EXPECT_EQ(state(), 0x27);
  control(0x07);
  EXPECT_EQ(state(), 0x23);
  control(0x06);
  EXPECT_EQ(state(), 0x21);
  control(0x00);
  EXPECT_EQ(state(), 0x40);
}

/// Where each command leads from each state (statusword & 6F), by the standard's transitions.
struct CommandRow {
  std::uint16_t word;
  const char* name;
  std::uint16_t from_disabled, from_ready, from_switched_on, from_enabled, from_quick_stop;
};

TEST_F(DriveDeviceTest, EveryStateTakesEveryCommandAsTheStandardSays) {
  const CommandRow rows[] = {
      {0x06, "shutdown", 0x21 /*2*/, 0x21, 0x21 /*6*/, 0x21 /*8*/, 0x07},
      {0x07, "switch on", 0x40, 0x23 /*3*/, 0x23, 0x23 /*5*/, 0x07},
      {0x0F, "enable operation", 0x40, 0x27 /*3 and 4*/, 0x27 /*4*/, 0x27, 0x27 /*16, as 605A is 6*/},
      {0x02, "quick stop", 0x40, 0x40 /*7*/, 0x40 /*10*/, 0x07 /*11*/, 0x07},
      {0x00, "disable voltage", 0x40, 0x40 /*7*/, 0x40 /*10*/, 0x40 /*9*/, 0x40 /*12*/},
      {0x80, "fault reset", 0x40, 0x40 /*7*/, 0x40 /*10*/, 0x40 /*9*/, 0x40 /*12*/},
  };
  const std::vector<std::vector<std::uint16_t>> ways{
      {}, {0x06}, {0x06, 0x07}, {0x06, 0x07, 0x0F}, {0x06, 0x07, 0x0F, 0x02}};
  run(50ms);
  write(0x6060, 9, 1);
  ASSERT_EQ(write(0x605A, 6, 2), 0u);
  for (const CommandRow& row : rows) {
    const std::uint16_t expected[] = {row.from_disabled, row.from_ready, row.from_switched_on, row.from_enabled,
                                      row.from_quick_stop};
    for (std::size_t i = 0; i < ways.size(); ++i) {
      control(0x00);
      for (const std::uint16_t word : ways[i]) control(word, 30ms);
      control(row.word, 30ms);
      EXPECT_EQ(state(), expected[i]) << row.name << " from state " << i;
    }
  }
}

TEST_F(DriveDeviceTest, AQuickStopThatEndsWithoutPowerIsNotResumedByAnOldControlword) {
  enable();
  ASSERT_EQ(write(0x605A, 2, 2), 0u);
  ASSERT_EQ(write(0x6085, 40000, 4), 0u);
  write(0x60FF, 20000, 4);
  run(300ms);
  control(0x02, 20ms);
  ASSERT_EQ(state(), 0x07);
  for (int i = 0; i < 1000; ++i) {
    control(0x0F, 1ms);  // transition 16 exists for 605A = 5..8 only
    ASSERT_NE(state(), 0x27);
  }
  EXPECT_EQ(state(), 0x40);
}

TEST_F(DriveDeviceTest, FollowsATargetWithDeadTimeAndBandwidth) {
  enable();
  write(0x60FF, 10000, 4);
  run(3ms);
  EXPECT_NEAR(rps(), 0.0, 1e-9) << "dead time";
  run(10ms);
  EXPECT_NEAR(rps(), 10.0 * (1.0 - std::exp(-1.0)), 0.5) << "one time constant";
  run(100ms);
  EXPECT_NEAR(rps(), 10.0, 0.01);
}

TEST_F(DriveDeviceTest, MeasuresSpeedAndPositionThroughItsEncoder) {
  enable();
  write(0x60FF, -10000, 4);
  run(500ms);
  const sim::ObjectDictionary& objects = drive.communication().objects();
  EXPECT_NEAR(objects.get_signed(0x606C), -10000, 1000.0 / 4096 / 0.004 + 1) << "one count over the window";
  EXPECT_NEAR(objects.get_signed(0x6064), drive.axis().position_rev() * 4096, 1.0);
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) {
    run(1ms);
    sum += objects.get_signed(0x606C);
  }
  EXPECT_NEAR(sum / 1000, -10000, 10) << "no bias";
}

struct QuickStopRow {
  int option;          ///< 605A
  int ramp_rps2;       ///< expected deceleration
  std::uint16_t ends;  ///< statusword & 6F at the end
};

TEST_F(DriveDeviceTest, QuickStopRampsByItsOption) {
  for (const QuickStopRow row :
       {QuickStopRow{2, 40, 0x40}, QuickStopRow{6, 40, 0x07}, QuickStopRow{1, 20, 0x40}, QuickStopRow{5, 20, 0x07}}) {
    enable();
    ASSERT_EQ(write(0x605A, row.option, 2), 0u);
    ASSERT_EQ(write(0x6084, 20000, 4), 0u);
    ASSERT_EQ(write(0x6085, 40000, 4), 0u);
    write(0x60FF, 20000, 4);
    run(300ms);
    control(0x02, 1ms);
    EXPECT_EQ(state(), 0x07) << row.option;
    int ms = 0;
    while (std::abs(rps()) > 1.0 && ms < 3000) run(1ms), ++ms;
    EXPECT_NEAR(ms, 1000 * 19.0 / row.ramp_rps2, 20) << row.option;
    run(200ms);
    EXPECT_EQ(state(), row.ends) << row.option;
    axis_radps = 0.0;
    control(0x00);
  }
}

TEST_F(DriveDeviceTest, AFaultBrakesThenNeedsTheEdge) {
  enable();
  write(0x60FF, 10000, 4);
  run(300ms);
  drive.raise_fault(0x2310);
  run(5ms);
  EXPECT_EQ(state() & 0x4F, 0x0F);
  run(3s);
  EXPECT_EQ(state() & 0x4F, 0x08);
  EXPECT_EQ(command.power, sim::AxisPower::unpowered);
  EXPECT_EQ(drive.communication().objects().get(0x603F), 0x2310u);
  control(0x8F);
  EXPECT_EQ(state(), 0x40);
  drive.raise_fault(0x2310);
  run(5ms);
  control(0x8F);
  EXPECT_EQ(state() & 0x4F, 0x08) << "bit 7 stayed high";
  control(0x00);
  control(0x80);
  EXPECT_EQ(state(), 0x40);
}

TEST_F(DriveDeviceTest, TheModeShowsInThe6061Only) {
  run(50ms);
  EXPECT_EQ(write(0x6060, 3, 1), 0u);
  run(1ms);
  EXPECT_EQ(drive.communication().objects().get_signed(0x6061), 3);
  EXPECT_EQ(write(0x6060, 1, 1), 0x06090030u) << "profile position is not supported";
}

TEST_F(DriveDeviceTest, ALostMasterActsBy6007AndItsLastControlwordIsVoid) {
  for (const int option : {0, 1, 2, 3}) {
    enable();
    ASSERT_EQ(write(0x6007, option, 2), 0u);
    write(0x60FF, 5000, 4);
    run(200ms);
    CanBus& master = bus.make_endpoint();
    master.send(frame("000#0205"));  // NMT stop is a lost connection too
    bus.deliver();
    run(10ms);
    const std::uint16_t expected[] = {0x27, 0x0F, 0x40, 0x07};
    EXPECT_EQ(state() & (option == 1 ? 0x4F : 0x6F), expected[option]) << option;
    run(3s);
    if (option != 0) {
      EXPECT_FALSE(drive.operation_enabled()) << "resumed by an old controlword";
    }
    master.send(frame("000#0105"));
    bus.deliver();
    run(5ms);
    axis_radps = 0.0;
    write(0x60FF, 0, 4);
    control(0x00);
    control(0x80);
    control(0x00);
  }
}

TEST_F(DriveDeviceTest, AKilledNodeIsSilentAndLeavesItsAxisAsSaid) {
  enable();
  bus.deliver();
  CanBus& listener = bus.make_endpoint();
  drive.kill(sim::AxisPower::braked);
  run(500ms);
  bus.deliver();
  EXPECT_EQ(command.power, sim::AxisPower::braked);
  EXPECT_FALSE(listener.receive());
}

}  // namespace
}  // namespace hogline::hw::test
