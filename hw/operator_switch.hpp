// Port: the operator's dead-man's switch. Held: the robot may move.
#pragma once

#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

struct OperatorSwitchState {
  bool held = false;
  Stamp stamp{};  ///< when it was read; the epoch: never
};

/// Neither call blocks. Whatever goes wrong with it (unplugged, silent) shows as a stamp that ages: that stops the
/// robot.
class OperatorSwitch {
 public:
  virtual ~OperatorSwitch() = default;
  virtual void step(Stamp now) = 0;
  virtual OperatorSwitchState state() const = 0;
};

/// Held by whoever runs the program: simulated throws, and tests that let it go.
class HeldSwitch final : public OperatorSwitch {
 public:
  void step(Stamp now) override { stamp_ = now; }
  OperatorSwitchState state() const override { return {held_, stamp_}; }
  void hold(bool held) { held_ = held; }

 private:
  bool held_ = true;
  Stamp stamp_{};
};

}  // namespace hogline::hw
