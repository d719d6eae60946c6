#include "hw/canopen/cia402_stepper.hpp"

namespace hogline::hw {

Cia402Command Cia402Stepper::resting_command(Cia402State state, Cia402Goal goal) const {
  switch (goal) {
    case Cia402Goal::stopped:
      return Cia402Command::quick_stop;  // in every state: it brakes or it takes power away
    case Cia402Goal::enabled:
      if (state == Cia402State::operation_enabled) return Cia402Command::enable_operation;
      return Cia402Command::disable_voltage;
    case Cia402Goal::off:
    case Cia402Goal::reset:
      break;
  }
  return Cia402Command::disable_voltage;
}

Cia402Command Cia402Stepper::step(Cia402State state, Cia402Goal goal, Stamp now) {
  const std::optional<Cia402Transition> next = next_transition(state, goal);
  if (!next) {
    pending_.reset();
    reset_edge_high_ = false;
    return resting_command(state, goal);
  }
  if (!pending_ || pending_->transition.number != next->number) pending_ = Pending{*next, now};

  // Fault reset acts on the rising edge: bit 7 low, then high, until the drive has seen one.
  if (next->number == 15) {
    reset_edge_high_ = !reset_edge_high_;
    return reset_edge_high_ ? Cia402Command::disable_voltage : Cia402Command::fault_reset;
  }
  return *next->command;
}

std::optional<Cia402Transition> Cia402Stepper::overdue(Stamp now, Duration quick_stop, Duration other) const {
  if (!pending_) return std::nullopt;
  const Duration deadline = pending_->transition.number == 11 ? quick_stop : other;
  if (now - pending_->since <= deadline) return std::nullopt;
  return pending_->transition;
}

}  // namespace hogline::hw
