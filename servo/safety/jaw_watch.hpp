// What the supervisor knows of the jaws: whether a trial has set the stone down, and how long they take to let go.
#pragma once

#include <optional>

#include "servo/command.hpp"
#include "servo/observation.hpp"
#include "servo/thrower_config.hpp"

namespace hogline::servo {

/// The stone comes free no sooner and no later than this after the order. Bounds, not an estimate.
struct DelayBounds {
  double least_s = 0.0;
  double most_s = 0.0;
};

/// The rig's word, until the jaws have been tried; then what they were seen to take, from the permitted order to their
/// own report, and their jitter.
class JawWatch {
 public:
  explicit JawWatch(const ReleaseConfig& config) : config_(config) {}

  void observe(const ThrowerObservation& observation);
  /// A trial's order has been let pass.
  void permitted(JawTrial trial, Stamp now);

  /// The jaws have been told to open in a trial, and have not been seen to hold the stone again.
  bool set_down() const { return trial_ != Trial::none; }
  DelayBounds delay() const;

 private:
  enum class Trial { none, ordered, open };
  ReleaseConfig config_;
  Trial trial_ = Trial::none;
  Stamp ordered_{};
  bool timed_ = false;  ///< this trial's delay has been taken
  std::optional<DelayBounds> seen_;
};

}  // namespace hogline::servo
