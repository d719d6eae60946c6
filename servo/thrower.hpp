// The thrower's state machine: unfold, rehearse, measure, align, fold, run, release, brake, stopped.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "servo/command.hpp"
#include "servo/observation.hpp"
#include "servo/shot.hpp"
#include "servo/thrower_config.hpp"

namespace hogline::servo {

enum class ThrowerState { unfold, rehearse, measure, align, fold, run, release, brake, stopped };

const char* to_string(ThrowerState state);

/// When a state was entered.
struct StateEntry {
  ThrowerState state = ThrowerState::unfold;
  Stamp since{};
};

/// The stone at the moment it was free, as the controller believes. In e.
struct FreedStone {
  Stamp stamp{};
  double x_m = 0.0;
  double y_m = 0.0;
  double speed_mps = 0.0;
  double heading_rad = 0.0;
  double spin_radps = 0.0;  ///< counter-clockwise positive
};

/// What the controller believes, for drawings and logs. Truth is elsewhere.
struct ThrowerDiagnosis {
  double yaw_rad = 0.0;  ///< fused heading in e
  double yaw_sigma_rad = 0.0;
  double hog_distance_m = 0.0;  ///< filtered, of b's origin
  double hog_distance_sigma_m = 0.0;
  double lateral_m = 0.0;  ///< from the shot's line, left positive
  double speed_mps = 0.0;
  double speed_setpoint_mps = 0.0;
  int slipping_periods = 0;  ///< control periods in which the wheels spun
  std::optional<double> yaw_after_alignment_rad;
  std::optional<Stamp> predicted_release;  ///< when the stone's release plane will be crossed
  std::optional<Stamp> release_ordered;
  std::vector<double> rehearsed_delays_s;    ///< the same of each trial in the hack
  std::optional<double> believed_delay_s;    ///< with which the release was timed
  std::optional<double> measured_delay_s;    ///< from the order to the stone being free, by the jaws' own report
  std::optional<double> freed_at_speed_mps;  ///< the body's, as believed when the stone was free
  std::optional<FreedStone> freed;
};

/// One throw, from a robot that stands and holds a stone to a robot that stands. Pure: no clock, no thread, no device.
/// Every state has a deadline; a deadline, a device error, or stale or non-finite input aborts: the stone is kept, the
/// robot brakes and ends in `stopped`, and nothing moves again (a new Thrower is a new arming).
class Thrower {
 public:
  Thrower(const ThrowerConfig& config, const ShotOrder& order, Stamp start);
  ~Thrower();
  Thrower(Thrower&&) noexcept;
  Thrower& operator=(Thrower&&) noexcept;

  /// One control period. `observation.now` must not go back; `dt` is the time since the last call.
  ThrowerCommand step(const ThrowerObservation& observation, Duration dt);

  ThrowerState state() const;
  bool finished() const;  ///< stopped, and at rest
  bool released() const;  ///< the stone was let go
  const std::optional<std::string>& abort_reason() const;
  const std::vector<StateEntry>& history() const;
  const ThrowerDiagnosis& diagnosis() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hogline::servo
