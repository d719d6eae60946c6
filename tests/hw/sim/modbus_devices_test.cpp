// The simulated Modbus devices, asked over a socket by a plain libmodbus client that knows only doc/modbus.md.
#include <gtest/gtest.h>
#include <modbus/modbus.h>

#include <array>
#include <cerrno>
#include <memory>

#include "hw/sim/modbus_devices.hpp"

namespace hogline::hw::sim {
namespace {

using namespace std::chrono_literals;

constexpr GripperScenario gripper{.opening_delay_s = 0.075,
                                  .opening_jitter_s = 0.002,
                                  .motion_delay_s = 0.02,
                                  .holds_stone_at_start = true,
                                  .activation_time_s = 2.0,
                                  .full_stroke_time_s = 0.6};
constexpr SpinBeltScenario belt{.acceleration_radps2 = 4.0, .max_speed_radps = 3.0, .watchdog_s = 0.2};
constexpr ArmScenario arm{.travel_time_s = 1.5, .unfolded_at_start = false, .watchdog_s = 0.2};

struct FreeContext {
  void operator()(modbus_t* context) const {
    modbus_close(context);
    modbus_free(context);
  }
};

class Rig {
 public:
  explicit Rig(std::uint64_t seed = 1) : devices(gripper, belt, arm, seed, Stamp{}) { connect(); }

  void connect() {
    client.reset(modbus_new_tcp("127.0.0.1", devices.port()));
    modbus_set_response_timeout(client.get(), 0, 500000);
    connected = modbus_connect(client.get()) == 0;
  }
  template <std::size_t N>
  bool write(int unit, int address, std::array<std::uint16_t, N> values) {
    modbus_set_slave(client.get(), unit);
    return modbus_write_registers(client.get(), address, N, values.data()) == static_cast<int>(N);
  }
  template <std::size_t N>
  std::array<std::uint16_t, N> read(int unit, int address) {
    std::array<std::uint16_t, N> values{};
    modbus_set_slave(client.get(), unit);
    EXPECT_EQ(modbus_read_input_registers(client.get(), address, N, values.data()), static_cast<int>(N));
    return values;
  }
  void run(Duration span, bool refreshing = true) {
    for (const Stamp end = now + span; now < end;) {
      now += 5ms;
      if (refreshing) {
        ++watchdog;
        write(10, 0x0103, std::array{watchdog});
        write(11, 0x0103, std::array{watchdog});
      }
      devices.step(now);
    }
  }

  ModbusDevices devices;
  std::unique_ptr<modbus_t, FreeContext> client;
  bool connected = false;
  Stamp now{};
  std::uint16_t watchdog = 0;
};

const std::array<std::uint16_t, 3> open_fast{0x0900, 0x0000, 0xFFFF};

TEST(SimulatedJaws, start_with_the_stone_gripped) {
  Rig rig;
  ASSERT_TRUE(rig.connected);
  EXPECT_EQ((rig.read<3>(9, 0x07D0)), (std::array<std::uint16_t, 3>{0xB900, 0x00FF, 0xBD10}));
  EXPECT_TRUE(rig.devices.effects().stone_in_jaws);
}

TEST(SimulatedJaws, let_the_stone_go_after_their_delay) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rig rig(seed);
    rig.run(50ms);
    const Stamp ordered = rig.now;
    ASSERT_TRUE(rig.write(9, 0x03E8, open_fast));
    const auto free_at = rig.devices.effects().stone_free_at;
    ASSERT_TRUE(free_at);
    EXPECT_NEAR(seconds(*free_at - ordered), 0.075, 0.010) << "seed " << seed;
    rig.run(60ms);
    EXPECT_TRUE(rig.devices.effects().stone_in_jaws);
    EXPECT_EQ((rig.read<3>(9, 0x07D0)[0]), 0x3900) << "moving";
    rig.run(1s);
    EXPECT_FALSE(rig.devices.effects().stone_in_jaws);
    EXPECT_EQ((rig.read<3>(9, 0x07D0)[0]), 0xF900) << "open";
  }
}

TEST(SimulatedJaws, the_same_seed_gives_the_same_delay_and_another_seed_another) {
  const auto delay = [](std::uint64_t seed) {
    Rig rig(seed);
    rig.write(9, 0x03E8, open_fast);
    return rig.devices.effects().stone_free_at.value_or(Stamp{});
  };
  EXPECT_EQ(delay(5), delay(5));
  EXPECT_NE(delay(5), delay(6));
}

TEST(SimulatedBelt, reaches_its_speed_with_its_acceleration) {
  Rig rig;
  rig.run(10ms);
  ASSERT_TRUE(rig.write(10, 0x0100, std::array<std::uint16_t, 3>{1, 1, 1200}));
  rig.run(150ms);
  EXPECT_NEAR(rig.devices.effects().belt_radps, 0.6, 0.03);
  rig.run(300ms);
  const auto inputs = rig.read<8>(10, 0x0200);
  EXPECT_EQ(inputs[0], 0x4231);
  EXPECT_EQ(inputs[1], 1) << "sequence echo";
  EXPECT_EQ(inputs[3], 0x0003) << "moving, at target";
  EXPECT_EQ(inputs[5], 1200);
}

TEST(SimulatedBelt, stops_when_its_watchdog_is_not_refreshed_and_stays_so) {
  Rig rig;
  rig.run(10ms);
  rig.write(10, 0x0100, std::array<std::uint16_t, 3>{1, 1, 1200});
  rig.run(400ms);
  rig.run(1s, false);
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0);
  rig.run(100ms);
  EXPECT_EQ(rig.read<8>(10, 0x0200)[3] & 0x04, 0x04) << "refreshing does not clear the trip";
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0);
  ASSERT_TRUE(rig.write(10, 0x0100, std::array<std::uint16_t, 3>{2, 1, 1200}));
  rig.run(400ms);
  EXPECT_NEAR(rig.devices.effects().belt_radps, 1.2, 1e-9);
}

TEST(SimulatedAxes, latch_a_fault_until_it_is_reset_by_its_command) {
  Rig rig;
  rig.run(10ms);
  const auto faulted = [&rig] { return (rig.read<8>(10, 0x0200)[3] & 0x08) != 0; };
  ASSERT_TRUE(rig.write(10, 0x0100, std::array<std::uint16_t, 3>{1, 1, 1200}));
  rig.run(100ms);
  rig.devices.inject([](auto&, auto& device, auto&) { device.set_fault(1); });
  rig.run(1s);
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0);
  EXPECT_FALSE(rig.write(10, 0x0100, std::array<std::uint16_t, 3>{2, 3, 0})) << "its cause is still there";
  rig.devices.inject([](auto&, auto& device, auto&) { device.set_fault(0); });
  EXPECT_TRUE(faulted()) << "latched";
  EXPECT_FALSE(rig.write(10, 0x0100, std::array<std::uint16_t, 3>{2, 1, 1200})) << "runs only after the reset";
  EXPECT_TRUE(rig.write(10, 0x0100, std::array<std::uint16_t, 3>{2, 0, 0})) << "a stop is always taken";
  EXPECT_TRUE(faulted()) << "and clears nothing";
  EXPECT_TRUE(rig.write(10, 0x0100, std::array<std::uint16_t, 3>{3, 3, 0}));
  EXPECT_FALSE(faulted());
  rig.run(500ms);
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0) << "stands until the next command";
}

TEST(SimulatedAxes, answer_wrong_requests_with_the_documented_exceptions) {
  struct Case {
    const char* what;
    int unit;
    int address;
    std::array<std::uint16_t, 3> values;
    int error;
  };
  const Case cases[] = {
      {"sequence 0", 10, 0x0100, {0, 1, 100}, EMBXILVAL},
      {"an unknown command", 10, 0x0100, {1, 7, 100}, EMBXILVAL},
      {"faster than the limit", 10, 0x0100, {1, 1, 3001}, EMBXILVAL},
      {"an argument for the arm", 11, 0x0100, {1, 1, 1}, EMBXILVAL},
      {"an address beside the map", 10, 0x0200, {1, 1, 1}, EMBXILADD},
      {"a command over the watchdog", 10, 0x0101, {1, 1, 1}, EMBXILADD},
      {"an unknown unit", 12, 0x0100, {1, 1, 1}, EMBXGTAR},
  };
  Rig rig;
  rig.run(10ms);
  for (const auto& c : cases) {
    EXPECT_FALSE(rig.write(c.unit, c.address, c.values)) << c.what;
    EXPECT_EQ(errno, c.error) << c.what;
  }
}

TEST(SimulatedAxes, take_no_command_before_a_refresh) {
  Rig rig;
  EXPECT_FALSE(rig.write(11, 0x0100, std::array<std::uint16_t, 3>{1, 2, 0}));
  EXPECT_EQ(errno, EMBXSFAIL);
}

TEST(SimulatedArm, takes_its_time_each_way_and_says_where_it_is) {
  Rig rig;
  rig.run(10ms);
  EXPECT_EQ(rig.read<8>(11, 0x0200)[3] & 0x31, 0x10) << "folded";
  ASSERT_TRUE(rig.write(11, 0x0100, std::array<std::uint16_t, 3>{1, 2, 0}));
  rig.run(750ms);
  EXPECT_NEAR(rig.devices.effects().arm_unfolded, 0.5, 0.01);
  EXPECT_EQ(rig.read<8>(11, 0x0200)[3] & 0x31, 0x01) << "moving";
  rig.run(760ms);
  EXPECT_EQ(rig.read<8>(11, 0x0200)[3] & 0x31, 0x20) << "unfolded";
}

TEST(SimulatedServer, refuses_connections_while_stopped_and_takes_them_again) {
  Rig rig;
  rig.devices.stop();
  rig.connect();
  EXPECT_FALSE(rig.connected);
  rig.devices.restart();
  rig.connect();
  EXPECT_TRUE(rig.connected);
  rig.read<3>(9, 0x07D0);
}

TEST(SimulatedServer, accepts_but_never_answers_while_stalled) {
  Rig rig;
  rig.devices.stall();
  rig.connect();
  ASSERT_TRUE(rig.connected);
  EXPECT_FALSE(rig.write(9, 0x03E8, open_fast));
  EXPECT_EQ(errno, ETIMEDOUT);
  EXPECT_FALSE(rig.devices.effects().stone_free_at) << "nothing was carried out";
}

}  // namespace
}  // namespace hogline::hw::sim
