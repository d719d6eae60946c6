// CiA 402 as tables: every statusword, every transition, one step at a time.
#include <gtest/gtest.h>

#include <set>

#include "hw/canopen/cia402.hpp"
#include "hw/canopen/cia402_stepper.hpp"

namespace hogline::hw::test {
namespace {

using namespace std::chrono_literals;
using State = Cia402State;
using Goal = Cia402Goal;
using Command = Cia402Command;

constexpr Stamp t0{100s};

/// The standard's bit pattern "xxxx xxxx x0xx 0000": x matches both.
bool matches(const char* pattern, std::uint16_t word) {
  int bit = 15;
  for (const char* c = pattern; *c; ++c) {
    if (*c == ' ') continue;
    const bool set = (word >> bit--) & 1;
    if ((*c == '0' && set) || (*c == '1' && !set)) return false;
  }
  return true;
}

TEST(Statusword, All65536AgreeWithTheStandardsPatterns) {
  const std::pair<const char*, State> patterns[] = {
      {"xxxx xxxx x0xx 0000", State::not_ready_to_switch_on}, {"xxxx xxxx x1xx 0000", State::switch_on_disabled},
      {"xxxx xxxx x01x 0001", State::ready_to_switch_on},     {"xxxx xxxx x01x 0011", State::switched_on},
      {"xxxx xxxx x01x 0111", State::operation_enabled},      {"xxxx xxxx x00x 0111", State::quick_stop_active},
      {"xxxx xxxx x0xx 1111", State::fault_reaction_active},  {"xxxx xxxx x0xx 1000", State::fault},
  };
  for (int word = 0; word <= 0xFFFF; ++word) {
    State expected = State::unknown;
    for (const auto& [pattern, state] : patterns) {
      if (matches(pattern, static_cast<std::uint16_t>(word))) expected = state;
    }
    ASSERT_EQ(decode_statusword(static_cast<std::uint16_t>(word)), expected) << std::hex << word;
  }
}

TEST(Statusword, WhatTheTableDoesNotKnowIsUnknown) {
  for (const int word : {0x0001, 0x0023 & ~0x20, 0x0067, 0x0048, 0x0002, 0x006F}) {
    EXPECT_EQ(decode_statusword(static_cast<std::uint16_t>(word)), State::unknown) << std::hex << word;
  }
}

TEST(Transitions, AreNumberedInOrder) {
  int number = 0;
  for (const Cia402Transition& transition : cia402_transitions()) EXPECT_EQ(transition.number, number++);
  EXPECT_EQ(number, 17);
}

const std::vector<State> all_states{
    State::unknown,     State::not_ready_to_switch_on, State::switch_on_disabled, State::ready_to_switch_on,
    State::switched_on, State::operation_enabled,      State::quick_stop_active,  State::fault_reaction_active,
    State::fault};

TEST(Transitions, FollowingTheGoalArrivesWithoutACycle) {
  for (const Goal goal : {Goal::off, Goal::enabled, Goal::stopped, Goal::reset}) {
    for (State state : all_states) {
      int steps = 0;
      while (const auto next = next_transition(state, goal)) {
        ASSERT_EQ(next->from, state);
        ASSERT_TRUE(next->command);
        state = next->to;
        ASSERT_LT(++steps, 6) << to_string(state);
      }
    }
  }
}

TEST(Transitions, OnlyResetLeavesAFaultAndNothingResumesAQuickStop) {
  for (const Goal goal : {Goal::off, Goal::enabled, Goal::stopped}) EXPECT_FALSE(next_transition(State::fault, goal));
  EXPECT_EQ(next_transition(State::fault, Goal::reset)->number, 15);
  for (const Goal goal : {Goal::off, Goal::enabled, Goal::stopped, Goal::reset}) {
    const auto next = next_transition(State::quick_stop_active, goal);
    EXPECT_TRUE(!next || next->number == 12);
  }
}

TEST(Stepper, OneCommandThenItWaitsForTheState) {
  Cia402Stepper stepper;
  EXPECT_EQ(stepper.step(State::switch_on_disabled, Goal::enabled, t0), Command::shutdown);
  EXPECT_EQ(stepper.step(State::switch_on_disabled, Goal::enabled, t0 + 5ms), Command::shutdown);
  EXPECT_EQ(stepper.step(State::ready_to_switch_on, Goal::enabled, t0 + 10ms), Command::switch_on);
  EXPECT_EQ(stepper.step(State::switched_on, Goal::enabled, t0 + 15ms), Command::enable_operation);
  EXPECT_EQ(stepper.step(State::operation_enabled, Goal::enabled, t0 + 20ms), Command::enable_operation);
}

TEST(Stepper, StoppingIsCommandedInEveryState) {
  for (const State state : all_states) {
    Cia402Stepper stepper;
    EXPECT_EQ(stepper.step(state, Goal::stopped, t0), Command::quick_stop) << to_string(state);
  }
}

TEST(Stepper, UnknownIsNeverEnabled) {
  Cia402Stepper stepper;
  EXPECT_EQ(stepper.step(State::unknown, Goal::enabled, t0), Command::disable_voltage);
  EXPECT_EQ(stepper.step(State::fault, Goal::enabled, t0), Command::disable_voltage);
}

TEST(Stepper, FaultResetHasRisingEdges) {
  Cia402Stepper stepper;
  std::vector<Command> sent;
  for (int i = 0; i < 4; ++i) sent.push_back(stepper.step(State::fault, Goal::reset, t0 + i * 5ms));
  const std::vector<Command> expected{Command::disable_voltage, Command::fault_reset, Command::disable_voltage,
                                      Command::fault_reset};
  EXPECT_EQ(sent, expected);
}

TEST(Stepper, ATransitionThatDoesNotHappenIsOverdue) {
  Cia402Stepper stepper;
  static_cast<void>(stepper.step(State::operation_enabled, Goal::stopped, t0));
  EXPECT_FALSE(stepper.overdue(t0 + 50ms, 50ms, 500ms));
  ASSERT_TRUE(stepper.overdue(t0 + 51ms, 50ms, 500ms));
  EXPECT_EQ(stepper.overdue(t0 + 51ms, 50ms, 500ms)->number, 11);
  static_cast<void>(stepper.step(State::quick_stop_active, Goal::stopped, t0 + 60ms));
  EXPECT_FALSE(stepper.overdue(t0 + 10s, 50ms, 500ms));
}

}  // namespace
}  // namespace hogline::hw::test
