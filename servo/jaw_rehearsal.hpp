// The jaws tried before the run: how long they take to let go, by their own report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "servo/command.hpp"
#include "servo/observation.hpp"

namespace hogline::servo {

struct RehearsalStep {
  JawTrial order = JawTrial::none;
  bool done = false;
  std::string refused;  ///< why the jaws can not be relied on; empty as long as they can
};

/// While the robot stands in the hack the jaws open on the standing stone and grip it again, `times` times. Each time
/// tells one delay, from the order to the travel that frees the stone. Pure; one step a control period. It orders only
/// jaws: whoever uses it keeps everything else still.
class JawRehearsal {
 public:
  /// `jitter_s`: by which one delay differs from the next, one standard deviation.
  JawRehearsal(int times, double jitter_s) : times_(times), jitter_s_(jitter_s) {}

  RehearsalStep step(const GripperObservation& gripper, Stamp now);

  const std::vector<double>& delays_s() const { return delays_s_; }

 private:
  enum class Phase { holding, opening, gripping };
  RehearsalStep hold(const GripperObservation& gripper, Stamp now);
  RehearsalStep open(const GripperObservation& gripper, Stamp now);
  RehearsalStep grip(const GripperObservation& gripper, Stamp now);
  RehearsalStep finish() const;

  int times_;
  double jitter_s_;
  Phase phase_ = Phase::holding;
  std::optional<Stamp> since_;  ///< held, or ordered to open or grip, since
  std::vector<double> delays_s_;
};

}  // namespace hogline::servo
