// The drive state machine of CiA 402 (IEC 61800-7-201, 6.1), as tables.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace hogline::hw {

/// `unknown` is any statusword the standard does not define. It is no start state: it stops.
enum class Cia402State {
  unknown,
  not_ready_to_switch_on,
  switch_on_disabled,
  ready_to_switch_on,
  switched_on,
  operation_enabled,
  quick_stop_active,
  fault_reaction_active,
  fault,
};

/// Statusword 6041 by the mask/value table.
Cia402State decode_statusword(std::uint16_t statusword);
const char* to_string(Cia402State state);

/// Controlword 6040 values of the device control commands. Fault reset acts on its rising edge.
enum class Cia402Command : std::uint16_t {
  disable_voltage = 0x0000,
  quick_stop = 0x0002,
  shutdown = 0x0006,
  switch_on = 0x0007,  ///< from operation enabled: disable operation
  enable_operation = 0x000F,
  fault_reset = 0x0080,
};

/// A transition with the standard's number. Transitions 0, 1, 13 and 14 are the device's own: no command.
struct Cia402Transition {
  int number;
  Cia402State from;
  Cia402State to;
  std::optional<Cia402Command> command;
};

/// All transitions of the standard, in its order. Transition 13 leaves every state; it is listed from
/// operation enabled.
std::span<const Cia402Transition> cia402_transitions();

/// Where the master wants the drive to be.
enum class Cia402Goal {
  off,      ///< switch on disabled: no power
  enabled,  ///< operation enabled, one transition at a time
  stopped,  ///< quick stop active, or any state without power
  reset,    ///< out of fault to switch on disabled; otherwise as off
};

/// The next transition a master commands to get from `state` to `goal`; nothing when there, or when no command leads
/// there (a fault is left only by `reset`; quick stop active is never resumed by transition 16 but passes through off).
std::optional<Cia402Transition> next_transition(Cia402State state, Cia402Goal goal);

}  // namespace hogline::hw
