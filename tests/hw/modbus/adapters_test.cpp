// Gripper and arm adapters against the simulated devices behind a real socket.
#include <gtest/gtest.h>

#include <limits>

#include "tests/hw/modbus/modbus_rig.hpp"

namespace hogline::hw {
namespace {

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
  Rig rig({.holds = false});
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

TEST(ModbusArm, a_fault_is_reset_by_rearming_and_by_nothing_else) {
  Rig rig;
  rig.run(50ms);
  rig.arm.unfold();
  rig.run(300ms);
  rig.devices.inject([](auto&, auto&, auto& arm) { arm.set_fault(2); });
  rig.run(100ms);
  EXPECT_EQ(kind_of(rig.arm.state().error), DeviceErrorKind::device_fault);
  const double place = rig.devices.effects().arm_unfolded;

  rig.arm.rearm();
  rig.run(100ms);
  ASSERT_TRUE(rig.arm.state().error) << "its cause is still there";
  EXPECT_EQ(rig.arm.state().error->what, "blocked; the fault can not be reset");

  rig.devices.inject([](auto&, auto&, auto& arm) { arm.set_fault(0); });
  rig.arm.unfold();
  rig.run(500ms);
  EXPECT_TRUE(rig.arm.state().error) << "latched here";
  rig.devices.inject([](auto&, auto&, auto& arm) { EXPECT_EQ(arm.inputs()[3] & 0x08, 0x08) << "and there"; });

  rig.arm.rearm();
  rig.run(300ms);
  EXPECT_FALSE(rig.arm.state().error) << rig.arm.state().error->what;
  EXPECT_EQ(rig.devices.effects().arm_unfolded, place) << "nothing moves before a new order";
  rig.arm.unfold();
  rig.run(1600ms);
  EXPECT_EQ(rig.arm.state().position, ArmPosition::unfolded);
}

TEST(ModbusArm, a_fault_behind_a_dead_line_is_not_reset_by_the_rearming_before_it) {
  Rig rig;
  rig.run(50ms);
  rig.devices.stop();
  rig.run(200ms);
  rig.arm.rearm();
  rig.run(200ms);
  EXPECT_TRUE(rig.arm.state().error);
  rig.devices.inject([](auto&, auto&, auto& arm) {
    arm.set_fault(1);
    arm.set_fault(0);
  });
  rig.revive();
  rig.run(500ms);
  EXPECT_TRUE(rig.arm.state().error);
  rig.devices.inject([](auto&, auto&, auto& arm) { EXPECT_EQ(arm.inputs()[3] & 0x08, 0x08); });
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
