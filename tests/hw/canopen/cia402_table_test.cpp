// CiA 402 (IEC 61800-7-201): the standard's tables, written out here once more, against ours.
#include <gtest/gtest.h>

#include <map>

#include "hw/canopen/cia402.hpp"
#include "hw/canopen/cia402_stepper.hpp"

namespace hogline::hw::test {
namespace {

using namespace std::chrono_literals;
using State = Cia402State;
using Goal = Cia402Goal;

/// The standard's pattern of bits 7 and 3..0 of the controlword: fault reset, enable operation, quick stop (active
/// low), enable voltage, switch on.
bool fits(const char* pattern, std::uint16_t word) {
  const int bits[] = {7, 3, 2, 1, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    const bool set = (word >> bits[i]) & 1;
    if (pattern[i] != 'x' && (pattern[i] == '1') != set) return false;
  }
  return true;
}

struct Row {
  int number;
  State from;
  State to;
  const char* controlword;  ///< nullptr: the drive's own
};

constexpr Row standard[] = {
    {0, State::unknown, State::not_ready_to_switch_on, nullptr},
    {1, State::not_ready_to_switch_on, State::switch_on_disabled, nullptr},
    {2, State::switch_on_disabled, State::ready_to_switch_on, "0x110"},  // shutdown
    {3, State::ready_to_switch_on, State::switched_on, "00111"},         // switch on
    {4, State::switched_on, State::operation_enabled, "01111"},          // enable operation
    {5, State::operation_enabled, State::switched_on, "00111"},          // disable operation
    {6, State::switched_on, State::ready_to_switch_on, "0x110"},         // shutdown
    {7, State::ready_to_switch_on, State::switch_on_disabled, "0xx0x"},  // disable voltage
    {8, State::operation_enabled, State::ready_to_switch_on, "0x110"},   // shutdown
    {9, State::operation_enabled, State::switch_on_disabled, "0xx0x"},   // disable voltage
    {10, State::switched_on, State::switch_on_disabled, "0xx0x"},        // disable voltage
    {11, State::operation_enabled, State::quick_stop_active, "0x01x"},   // quick stop
    {12, State::quick_stop_active, State::switch_on_disabled, "0xx0x"},  // disable voltage
    {13, State::operation_enabled, State::fault_reaction_active, nullptr},
    {14, State::fault_reaction_active, State::fault, nullptr},
    {15, State::fault, State::switch_on_disabled, "1xxxx"},             // fault reset
    {16, State::quick_stop_active, State::operation_enabled, "01111"},  // enable operation
};

TEST(Cia402Table, EveryTransitionIsTheStandards) {
  const auto ours = cia402_transitions();
  ASSERT_EQ(ours.size(), std::size(standard));
  for (const Row& row : standard) {
    const Cia402Transition& transition = ours[static_cast<std::size_t>(row.number)];
    EXPECT_EQ(transition.number, row.number);
    EXPECT_EQ(transition.from, row.from) << row.number;
    EXPECT_EQ(transition.to, row.to) << row.number;
    ASSERT_EQ(transition.command.has_value(), row.controlword != nullptr) << row.number;
    if (row.controlword) {
      EXPECT_TRUE(fits(row.controlword, static_cast<std::uint16_t>(*transition.command))) << row.number;
    }
  }
}

/// What a master does in each state to get to each goal; 0: it waits.
struct GoalRow {
  State state;
  int off, enabled, stopped, reset;
};

constexpr GoalRow truth_table[] = {
    {State::unknown, 0, 0, 0, 0},
    {State::not_ready_to_switch_on, 0, 0, 0, 0},
    {State::switch_on_disabled, 0, 2, 0, 0},
    {State::ready_to_switch_on, 7, 3, 0, 7},
    {State::switched_on, 10, 4, 0, 10},
    {State::operation_enabled, 9, 0, 11, 9},
    {State::quick_stop_active, 12, 12, 0, 12},
    {State::fault_reaction_active, 0, 0, 0, 0},
    {State::fault, 0, 0, 0, 15},
};

TEST(Cia402Table, EveryStateAndGoalHasItsTransition) {
  for (const GoalRow& row : truth_table) {
    for (const auto& [goal, number] : std::map<Goal, int>{{Goal::off, row.off},
                                                          {Goal::enabled, row.enabled},
                                                          {Goal::stopped, row.stopped},
                                                          {Goal::reset, row.reset}}) {
      const auto next = next_transition(row.state, goal);
      EXPECT_EQ(next ? next->number : 0, number) << to_string(row.state);
      if (!next) continue;
      Cia402Stepper stepper;
      std::uint16_t sent = 0;
      for (int step = 0; step < 2; ++step) {  // a reset needs its low before its edge
        sent = static_cast<std::uint16_t>(stepper.step(row.state, goal, Stamp{1s} + step * 5ms));
      }
      EXPECT_EQ(sent, static_cast<std::uint16_t>(*next->command)) << to_string(row.state);
    }
  }
}

TEST(Cia402Table, NoControlwordSentInAnyStateEnablesAgainstTheGoal) {
  for (const GoalRow& row : truth_table) {
    for (const Goal goal : {Goal::off, Goal::stopped, Goal::reset}) {
      Cia402Stepper stepper;
      for (int step = 0; step < 4; ++step) {
        const auto sent = static_cast<std::uint16_t>(stepper.step(row.state, goal, Stamp{1s} + step * 5ms));
        EXPECT_FALSE(fits("01111", sent)) << to_string(row.state);
      }
    }
  }
}

}  // namespace
}  // namespace hogline::hw::test
