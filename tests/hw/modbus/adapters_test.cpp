// Gripper and arm adapters against the simulated devices behind a real socket.
#include <gtest/gtest.h>

#include <limits>

#include "hw/modbus/modbus_arm.hpp"
#include "hw/modbus/modbus_gripper.hpp"
#include "hw/sim/modbus_devices.hpp"

namespace hogline::hw {
namespace {

using namespace std::chrono_literals;

sim::GripperScenario gripper_scenario(bool holds) {
  return {.opening_delay_s = 0.075,
          .opening_jitter_s = 0.002,
          .motion_delay_s = 0.02,
          .holds_stone_at_start = holds,
          .activation_time_s = 0.5,
          .full_stroke_time_s = 0.6};
}

class Rig {
 public:
  explicit Rig(bool holds = true, Duration reconnect_delay = 200ms)
      : devices(gripper_scenario(holds), {.acceleration_radps2 = 4.0, .max_speed_radps = 3.0, .watchdog_s = 0.2},
                {.travel_time_s = 1.5, .unfolded_at_start = false, .watchdog_s = 0.2}, 7, Stamp{}),
        session({.line = {.line = ModbusTcp{"127.0.0.1", devices.port()}, .response_timeout = 200ms},
                 .reconnect_delay = reconnect_delay}),
        gripper(session, {.jaws = {.unit = 9,
                                   .poll_period = 20ms,
                                   .echo_deadline = 60ms,
                                   .activation_deadline = 3s,
                                   .silence_limit = 60ms,
                                   .close_speed = 255,
                                   .close_force = 128},
                          .belt = {.unit = 10, .poll_period = 20ms, .echo_deadline = 60ms, .silence_limit = 60ms},
                          .max_spin_radps = 2.5}),
        arm(session, {.unit = 11, .poll_period = 20ms, .echo_deadline = 60ms, .silence_limit = 60ms}) {}

  void run(Duration span) {
    for (const Stamp end = now + span; now < end;) {
      now += 5ms;
      devices.step(now);
      gripper.step(now);
      arm.step(now);
    }
  }
  bool stone_held() const { return devices.effects().stone_in_jaws; }

  sim::ModbusDevices devices;
  ModbusSession session;
  ModbusGripper gripper;
  ModbusArm arm;
  Stamp now{};
};

DeviceErrorKind kind_of(const std::optional<DeviceError>& error) {
  EXPECT_TRUE(error.has_value());
  return error ? error->kind : DeviceErrorKind::implausible;
}

TEST(ModbusGripper, learns_that_a_stone_is_held_without_moving_anything) {
  Rig rig;
  rig.run(1s);
  const auto state = rig.gripper.state();
  EXPECT_EQ(state.jaws, JawState::holding);
  EXPECT_TRUE(state.activated);
  EXPECT_FALSE(state.error) << state.error->what;
  EXPECT_LE(seconds(rig.now - state.stamp), 0.02);
  EXPECT_TRUE(rig.stone_held());
}

TEST(ModbusGripper, a_release_goes_out_in_the_step_it_is_ordered_in) {
  Rig rig;
  rig.run(107ms);
  rig.gripper.release();
  const Stamp ordered = rig.now + 5ms;
  rig.run(5ms);
  const auto free_at = rig.devices.effects().stone_free_at;
  ASSERT_TRUE(free_at);
  EXPECT_NEAR(seconds(*free_at - ordered), 0.075, 0.008);
}

TEST(ModbusGripper, says_when_the_jaws_first_opened) {
  Rig rig;
  rig.run(100ms);
  EXPECT_FALSE(rig.gripper.state().opening_since);
  rig.gripper.release();
  const Stamp ordered = rig.now + 5ms;
  rig.run(800ms);
  const auto state = rig.gripper.state();
  ASSERT_TRUE(state.opening_since);
  EXPECT_NEAR(seconds(*state.opening_since - ordered), 0.02, 0.0051) << "first motion, seen in the next step";
  EXPECT_EQ(state.jaws, JawState::open);
  EXPECT_FALSE(state.error);
}

TEST(ModbusGripper, repeating_an_order_sends_nothing) {
  Rig rig;
  rig.run(100ms);
  rig.gripper.release();
  rig.gripper.spin(0.0);
  rig.run(1s);
  const auto before = rig.session.exchanges();
  Rig quiet;
  quiet.run(100ms);
  for (int i = 0; i < 40; ++i) {
    rig.gripper.release();
    rig.gripper.spin(0.0);
    rig.arm.fold();
    rig.run(5ms);
  }
  const auto quiet_before = quiet.session.exchanges();
  quiet.run(200ms);
  EXPECT_LE(rig.session.exchanges() - before, quiet.session.exchanges() - quiet_before + 2) << "but for one fold";
}

TEST(ModbusGripper, spins_the_stone_either_way_and_stops_it) {
  Rig rig;
  for (const double wanted : {1.2, -1.2, 0.0}) {
    rig.gripper.spin(wanted);
    rig.run(1s);
    EXPECT_NEAR(rig.gripper.state().spin_radps, wanted, 5e-4);
    EXPECT_NEAR(rig.devices.effects().belt_radps, wanted, 5e-4);
    EXPECT_FALSE(rig.gripper.state().error);
  }
}

TEST(ModbusGripper, activates_empty_jaws_and_grips_a_stone) {
  Rig rig(false);
  rig.run(50ms);
  EXPECT_FALSE(rig.gripper.state().activated);
  rig.devices.inject([](auto& jaws, auto&, auto&) { jaws.step(Stamp{50ms}); });
  rig.gripper.grip();
  rig.run(550ms);
  EXPECT_TRUE(rig.gripper.state().activated);
  rig.devices.inject([](auto& jaws, auto&, auto&) { jaws.place_stone(); });
  rig.run(1s);
  EXPECT_EQ(rig.gripper.state().jaws, JawState::holding);
  EXPECT_FALSE(rig.gripper.state().error) << rig.gripper.state().error->what;
}

TEST(ModbusGripper, never_activates_while_a_stone_may_be_held) {
  Rig rig;
  rig.run(100ms);
  rig.devices.inject([](auto& jaws, auto&, auto&) { jaws.cut_power(); });
  rig.run(100ms);
  EXPECT_EQ(kind_of(rig.gripper.state().error), DeviceErrorKind::device_fault);
  rig.gripper.grip();
  rig.gripper.release();
  rig.run(1s);
  EXPECT_TRUE(rig.stone_held());
  EXPECT_FALSE(rig.gripper.state().activated);
  rig.gripper.rearm();
  rig.run(1s);
  EXPECT_FALSE(rig.gripper.state().activated) << "re-arming alone moves nothing";
  EXPECT_TRUE(rig.stone_held());
}

TEST(ModbusGripper, reports_a_stone_lost_from_closed_jaws) {
  Rig rig;
  rig.run(100ms);
  rig.devices.inject([](auto& jaws, auto&, auto&) { jaws.lose_stone(); });
  rig.run(1s);
  EXPECT_EQ(kind_of(rig.gripper.state().error), DeviceErrorKind::device_fault);
  EXPECT_EQ(rig.gripper.state().jaws, JawState::closed_empty);
}

TEST(ModbusGripper, latches_each_fault_of_the_jaws) {
  for (const int fault : {0x05, 0x07, 0x08, 0x09, 0x0A, 0x0B, 0x0C, 0x0D, 0x0E, 0x0F}) {
    Rig rig;
    rig.run(100ms);
    rig.devices.inject([&](auto& jaws, auto&, auto&) { jaws.set_fault(static_cast<std::uint8_t>(fault)); });
    rig.run(40ms);
    rig.devices.inject([&](auto& jaws, auto&, auto&) { jaws.set_fault(0); });
    rig.run(40ms);
    EXPECT_EQ(kind_of(rig.gripper.state().error), DeviceErrorKind::device_fault) << fault;
    EXPECT_EQ(rig.gripper.state().jaws, JawState::holding) << fault;
  }
}

TEST(ModbusGripper, refuses_spins_that_are_too_fast_or_not_numbers) {
  for (const double wanted :
       {2.6, -2.6, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Rig rig;
    rig.gripper.spin(1.0);
    rig.run(500ms);
    rig.gripper.spin(wanted);
    rig.run(1s);
    EXPECT_EQ(kind_of(rig.gripper.state().error), DeviceErrorKind::implausible) << wanted;
    EXPECT_EQ(rig.devices.effects().belt_radps, 0.0) << "the belt's watchdog stops it";
    EXPECT_TRUE(rig.stone_held());
  }
}

TEST(ModbusArm, unfolds_and_folds) {
  Rig rig;
  rig.run(50ms);
  EXPECT_EQ(rig.arm.state().position, ArmPosition::folded);
  rig.arm.unfold();
  rig.run(500ms);
  EXPECT_EQ(rig.arm.state().position, ArmPosition::moving);
  rig.run(1100ms);
  EXPECT_EQ(rig.arm.state().position, ArmPosition::unfolded);
  rig.arm.fold();
  rig.run(1600ms);
  EXPECT_EQ(rig.arm.state().position, ArmPosition::folded);
  EXPECT_FALSE(rig.arm.state().error);
}

TEST(ModbusArm, a_restarted_device_is_an_error_and_does_not_move) {
  Rig rig;
  rig.run(50ms);
  rig.arm.unfold();
  rig.run(300ms);
  rig.devices.inject([](auto&, auto&, auto& arm) { arm.power_cycle(); });
  const double place = rig.devices.effects().arm_unfolded;
  rig.run(1s);
  EXPECT_EQ(kind_of(rig.arm.state().error), DeviceErrorKind::protocol);
  EXPECT_EQ(rig.devices.effects().arm_unfolded, place);
}

// Faults of the line. In each the stone stays held, the error has its kind, and nothing moves before a new order.
struct LineFault {
  const char* what;
  void (*inject)(sim::ModbusDevices&);
  void (*heal)(sim::ModbusDevices&);
  DeviceErrorKind kind;
};

void PrintTo(const LineFault& fault, std::ostream* out) { *out << fault.what; }

class ModbusLine : public testing::TestWithParam<LineFault> {};

TEST_P(ModbusLine, fault_keeps_the_stone_and_moves_nothing_until_rearmed) {
  const auto& fault = GetParam();
  Rig rig;
  rig.gripper.spin(1.0);
  rig.arm.unfold();
  rig.run(500ms);
  ASSERT_FALSE(rig.gripper.state().error);
  ASSERT_FALSE(rig.arm.state().error);

  fault.inject(rig.devices);
  rig.run(100ms);
  EXPECT_EQ(kind_of(rig.gripper.state().error), fault.kind) << rig.gripper.state().error->what;
  EXPECT_EQ(kind_of(rig.arm.state().error), fault.kind) << rig.arm.state().error->what;
  rig.gripper.release();  // an order into a dead line is dropped, not kept
  rig.run(1s);
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0) << "stopped by its watchdog";
  const double place = rig.devices.effects().arm_unfolded;

  fault.heal(rig.devices);
  rig.run(1s);
  EXPECT_TRUE(rig.gripper.state().error) << "latched";
  EXPECT_TRUE(rig.stone_held());
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0);
  EXPECT_EQ(rig.devices.effects().arm_unfolded, place);

  rig.gripper.rearm();
  rig.arm.rearm();
  rig.run(1s);
  EXPECT_FALSE(rig.gripper.state().error) << rig.gripper.state().error->what;
  EXPECT_FALSE(rig.arm.state().error);
  EXPECT_EQ(rig.gripper.state().jaws, JawState::holding);
  EXPECT_LE(seconds(rig.now - rig.gripper.state().stamp), 0.02) << "fresh again";
  EXPECT_EQ(rig.devices.effects().belt_radps, 0.0) << "re-arming alone moves nothing";
  EXPECT_EQ(rig.devices.effects().arm_unfolded, place);

  rig.gripper.spin(1.0);
  rig.arm.unfold();
  rig.run(2s);
  EXPECT_NEAR(rig.gripper.state().spin_radps, 1.0, 1e-3);
  EXPECT_EQ(rig.arm.state().position, ArmPosition::unfolded);
  rig.gripper.release();
  rig.run(1s);
  EXPECT_FALSE(rig.stone_held());
}

const LineFault line_faults[] = {
    {"the server dies", [](auto& d) { d.stop(); }, [](auto& d) { d.restart(); }, DeviceErrorKind::disconnected},
    {"it accepts but never answers", [](auto& d) { d.stall(); }, [](auto& d) { d.set_faults({}); },
     DeviceErrorKind::timeout},
    {"each answer is late", [](auto& d) { d.set_faults({.late = true}); }, [](auto& d) { d.set_faults({}); },
     DeviceErrorKind::timeout},
    {"every request gets an exception", [](auto& d) { d.set_faults({.exception = 6}); },
     [](auto& d) { d.set_faults({}); }, DeviceErrorKind::refused},
};
INSTANTIATE_TEST_SUITE_P(faults, ModbusLine, testing::ValuesIn(line_faults));

TEST(ModbusLine, one_lost_answer_is_forgiven) {
  Rig rig(true, 20ms);
  rig.run(100ms);
  rig.devices.stall();
  rig.run(5ms);
  rig.devices.set_faults({});
  rig.run(500ms);
  EXPECT_FALSE(rig.gripper.state().error);
  EXPECT_EQ(rig.session.connections(), 2U) << "the line was opened anew: no late answer can follow";
}

TEST(ModbusLine, an_axis_with_frozen_registers_is_found_by_the_watchdog_echo) {
  Rig rig;
  rig.run(100ms);
  rig.devices.set_faults({.freeze_inputs = true});
  const Stamp frozen = rig.now;
  rig.run(200ms);
  EXPECT_EQ(kind_of(rig.arm.state().error), DeviceErrorKind::protocol);
  EXPECT_LE(rig.arm.state().stamp, frozen);
  EXPECT_TRUE(rig.stone_held());
}

TEST(ModbusLine, a_release_whose_answer_is_lost_is_reported_and_seen) {
  Rig rig;
  rig.run(100ms);
  rig.devices.set_faults({.silent = true});
  rig.gripper.release();
  rig.run(5ms);
  EXPECT_EQ(kind_of(rig.gripper.state().error), DeviceErrorKind::timeout);
  rig.devices.set_faults({});
  rig.run(800ms);
  EXPECT_TRUE(rig.gripper.state().error) << "latched";
  EXPECT_EQ(rig.gripper.state().jaws, JawState::open) << "the order had arrived, and the state says so";
  EXPECT_TRUE(rig.gripper.state().opening_since);
}

TEST(ModbusLine, wrong_position_echo_is_a_protocol_error) {
  Rig rig;
  rig.run(100ms);
  rig.devices.set_faults({.freeze_inputs = true});
  rig.gripper.release();
  rig.run(200ms);
  EXPECT_EQ(kind_of(rig.gripper.state().error), DeviceErrorKind::protocol);
  EXPECT_FALSE(rig.gripper.state().opening_since);
}

TEST(ModbusLine, two_runs_are_alike_in_every_state) {
  const auto trace = [] {
    std::vector<double> numbers;
    Rig rig;
    rig.gripper.spin(1.0);
    rig.arm.unfold();
    for (int i = 0; i < 300; ++i) {
      if (i == 150) rig.gripper.release();
      rig.run(5ms);
      const auto state = rig.gripper.state();
      numbers.insert(numbers.end(),
                     {static_cast<double>(state.jaws), state.spin_radps, seconds(state.stamp.time_since_epoch()),
                      static_cast<double>(rig.arm.state().position), rig.devices.effects().stone_in_jaws ? 1.0 : 0.0});
    }
    return numbers;
  };
  EXPECT_EQ(trace(), trace());
}

}  // namespace
}  // namespace hogline::hw
