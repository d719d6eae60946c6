// Walks a drive through the CiA 402 states: one command, wait for its state, next command.
#pragma once

#include <optional>

#include "hw/canopen/cia402.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

class Cia402Stepper {
 public:
  /// The controlword to send now. A new goal starts a new wait.
  Cia402Command step(Cia402State state, Cia402Goal goal, Stamp now);

  /// The transition that was commanded and for which the drive has already been given longer than its deadline:
  /// `quick_stop` for transition 11, `other` for the rest.
  std::optional<Cia402Transition> overdue(Stamp now, Duration quick_stop, Duration other) const;

  /// Forgets the wait (the drive was reset).
  void restart() { pending_.reset(); }

 private:
  struct Pending {
    Cia402Transition transition;
    Stamp since;
  };

  Cia402Command resting_command(Cia402State state, Cia402Goal goal) const;

  std::optional<Pending> pending_;
  bool reset_edge_high_ = false;
};

}  // namespace hogline::hw
