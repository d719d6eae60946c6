// Stands between the controller and the devices. Nothing moves, and no stone is let go, but what it lets pass. It
// depends on no controller: it sees the same observations, and judges by bounds of its own.
#pragma once

#include <optional>
#include <string>

#include "servo/command.hpp"
#include "servo/observation.hpp"
#include "servo/safety/input_check.hpp"
#include "servo/safety/jaw_watch.hpp"
#include "servo/safety/latch.hpp"
#include "servo/safety/place_bounds.hpp"
#include "servo/safety/turn_agreement.hpp"

namespace hogline::servo {

enum class Supervision {
  disarmed,  ///< nothing has been allowed yet
  armed,     ///< what is within the bounds passes
  latched,   ///< stopped for `reason`; only arm() leaves this
};

class Supervisor {
 public:
  explicit Supervisor(const ThrowerConfig& config)
      : config_(config), agreement_(config.safety), jaws_(config.release) {}

  /// The operator's own act. Refused, with the reason, while the switch is not held, a device is in error or the wheels
  /// turn; and after a stop until the switch has been let go once.
  std::optional<std::string> arm(const ThrowerObservation& observation);

  /// What may be done of what is wanted, once a control period. Stopping always may. `dt`: since the last call.
  ThrowerCommand permit(const ThrowerObservation& observation, const ThrowerCommand& wanted, Duration dt);

  Supervision state() const { return state_; }
  const std::optional<std::string>& reason() const { return stop_.reason(); }
  /// The stone's release has been let pass. It then stays ordered: jaws that close on a sliding stone would burn it.
  bool released() const { return released_; }
  /// A trial has set the stone down in the hack, and it has not been seen held again.
  bool set_down() const { return jaws_.set_down(); }
  std::optional<HogBounds> place() const { return place_.now(); }
  /// Whether a stone still held could be stopped before the rules' limit by braking now; nothing while its place is not
  /// known.
  std::optional<bool> can_stop(Duration dt) const;

 private:
  bool active(const ThrowerCommand& wanted) const;
  void watch(const ThrowerObservation& observation);
  void take(const ThrowerObservation& observation);
  std::optional<std::string> judge(const ThrowerObservation& observation, const ThrowerCommand& wanted, Duration dt);
  InputNeeds needs(const ThrowerObservation& observation, const ThrowerCommand& wanted) const;
  std::optional<std::string> bad_motion(const ThrowerObservation& observation, Duration dt);
  std::optional<std::string> bad_place(Duration dt) const;
  std::optional<std::string> no_release(const ThrowerObservation& observation, Duration release_in) const;
  std::optional<std::string> no_trial(const ThrowerObservation& observation, const ThrowerCommand& wanted) const;
  ThrowerCommand only_stopping(const ThrowerCommand& wanted) const;

  ThrowerConfig config_;
  Supervision state_ = Supervision::disarmed;
  Latch stop_;
  TurnAgreement agreement_;
  PlaceBounds place_{config_.safety};
  JawWatch jaws_;
  std::optional<Stamp> last_now_;
  bool let_go_ = true;  ///< the switch, since the last stop
  bool at_rest_ = true;
  bool released_ = false;
  bool driven_ = false;  ///< the drives have been let follow orders since arming
};

}  // namespace hogline::servo
