#include "hw/canopen/cia402.hpp"

#include <array>

namespace hogline::hw {
namespace {

using State = Cia402State;
using Command = Cia402Command;

struct StatuswordRow {
  std::uint16_t mask;
  std::uint16_t value;
  State state;
};

constexpr std::array<StatuswordRow, 8> statusword_table{{
    {0x4F, 0x00, State::not_ready_to_switch_on},
    {0x4F, 0x40, State::switch_on_disabled},
    {0x6F, 0x21, State::ready_to_switch_on},
    {0x6F, 0x23, State::switched_on},
    {0x6F, 0x27, State::operation_enabled},
    {0x6F, 0x07, State::quick_stop_active},
    {0x4F, 0x0F, State::fault_reaction_active},
    {0x4F, 0x08, State::fault},
}};

// Transition 0 starts from power-off, which has no statusword: unknown.
constexpr std::array<Cia402Transition, 17> transitions{{
    {0, State::unknown, State::not_ready_to_switch_on, std::nullopt},
    {1, State::not_ready_to_switch_on, State::switch_on_disabled, std::nullopt},
    {2, State::switch_on_disabled, State::ready_to_switch_on, Command::shutdown},
    {3, State::ready_to_switch_on, State::switched_on, Command::switch_on},
    {4, State::switched_on, State::operation_enabled, Command::enable_operation},
    {5, State::operation_enabled, State::switched_on, Command::switch_on},
    {6, State::switched_on, State::ready_to_switch_on, Command::shutdown},
    {7, State::ready_to_switch_on, State::switch_on_disabled, Command::disable_voltage},
    {8, State::operation_enabled, State::ready_to_switch_on, Command::shutdown},
    {9, State::operation_enabled, State::switch_on_disabled, Command::disable_voltage},
    {10, State::switched_on, State::switch_on_disabled, Command::disable_voltage},
    {11, State::operation_enabled, State::quick_stop_active, Command::quick_stop},
    {12, State::quick_stop_active, State::switch_on_disabled, Command::disable_voltage},
    {13, State::operation_enabled, State::fault_reaction_active, std::nullopt},
    {14, State::fault_reaction_active, State::fault, std::nullopt},
    {15, State::fault, State::switch_on_disabled, Command::fault_reset},
    {16, State::quick_stop_active, State::operation_enabled, Command::enable_operation},
}};

struct GoalRow {
  Cia402Goal goal;
  State state;
  int transition;
};

constexpr std::array goal_table{
    GoalRow{Cia402Goal::enabled, State::switch_on_disabled, 2},
    GoalRow{Cia402Goal::enabled, State::ready_to_switch_on, 3},
    GoalRow{Cia402Goal::enabled, State::switched_on, 4},
    GoalRow{Cia402Goal::enabled, State::quick_stop_active, 12},
    GoalRow{Cia402Goal::off, State::ready_to_switch_on, 7},
    GoalRow{Cia402Goal::off, State::switched_on, 10},
    GoalRow{Cia402Goal::off, State::operation_enabled, 9},
    GoalRow{Cia402Goal::off, State::quick_stop_active, 12},
    GoalRow{Cia402Goal::stopped, State::operation_enabled, 11},
    GoalRow{Cia402Goal::reset, State::ready_to_switch_on, 7},
    GoalRow{Cia402Goal::reset, State::switched_on, 10},
    GoalRow{Cia402Goal::reset, State::operation_enabled, 9},
    GoalRow{Cia402Goal::reset, State::quick_stop_active, 12},
    GoalRow{Cia402Goal::reset, State::fault, 15},
};

}  // namespace

Cia402State decode_statusword(std::uint16_t statusword) {
  for (const StatuswordRow& row : statusword_table) {
    if ((statusword & row.mask) == row.value) return row.state;
  }
  return State::unknown;
}

const char* to_string(Cia402State state) {
  switch (state) {
    case State::not_ready_to_switch_on:
      return "not ready to switch on";
    case State::switch_on_disabled:
      return "switch on disabled";
    case State::ready_to_switch_on:
      return "ready to switch on";
    case State::switched_on:
      return "switched on";
    case State::operation_enabled:
      return "operation enabled";
    case State::quick_stop_active:
      return "quick stop active";
    case State::fault_reaction_active:
      return "fault reaction active";
    case State::fault:
      return "fault";
    case State::unknown:
      break;
  }
  return "unknown";
}

std::span<const Cia402Transition> cia402_transitions() { return transitions; }

std::optional<Cia402Transition> next_transition(Cia402State state, Cia402Goal goal) {
  for (const GoalRow& row : goal_table) {
    if (row.goal == goal && row.state == state) return transitions[static_cast<std::size_t>(row.transition)];
  }
  return std::nullopt;
}

}  // namespace hogline::hw
