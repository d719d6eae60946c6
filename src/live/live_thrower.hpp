// A thrower that stays: a member of the team (ThrowerMember) whose looks go on in a thread of their own, and whose
// operator arms it.
//
// Arming is pressing the switch: it must have been seen free and then held. An arming is good for one throw. Whatever
// goes wrong (a device, a silent peer, a called stop, the switch let go) ends it, and nothing moves before the next
// one.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "src/team/thrower_member.hpp"
#include "src/throwing/vision_thread.hpp"

namespace hogline {

enum class LivePhase { disarmed, arming, armed, throwing };

const char* to_string(LivePhase phase);

/// Used by one thread, which also steps the devices through it.
class LiveThrower {
 public:
  /// Who looks at the pictures: begins anew with each throw.
  using MakeSeer = std::function<std::unique_ptr<SheetSeer>()>;
  /// Told what happens, in a word and in words.
  using Tell = std::function<void(const char* event, const std::string& what)>;

  /// Devices, link and clock must outlive it.
  LiveThrower(const config::ThrowerRig& rig, const ThrowerDevices& devices, hw::TeamLink& link, MakeSeer make_seer,
              Tell tell);
  ~LiveThrower();
  LiveThrower(const LiveThrower&) = delete;
  LiveThrower& operator=(const LiveThrower&) = delete;

  /// One control period. `now` is the present time, `dt` the time since the last call.
  void step(Stamp now, Duration dt);
  /// As ThrowerLoop has them.
  std::optional<Stamp> release_due() const { return member_->release_due(); }
  void let_go(Stamp now) { member_->let_go(now); }
  /// The switch counts as let go from now on: a throw that is under way stops, with the stone held.
  void end();

  LivePhase phase() const { return phase_; }

 private:
  class ArmedSwitch;
  class FreshSeer;

  void watch_throw();
  void watch_switch(Stamp now);
  void step_arming(Stamp now);
  void tell_readiness();
  void tell_refusals(Stamp now);
  std::string not_ready(Stamp now) const;
  void enter(LivePhase phase, const std::string& why);

  Tell tell_;
  hw::Gyro& gyro_;
  hw::Drive& drive_;
  std::unique_ptr<ArmedSwitch> switch_;
  std::unique_ptr<FreshSeer> seer_;
  VisionThread looking_;
  std::unique_ptr<ThrowerMember> member_;

  LivePhase phase_ = LivePhase::disarmed;
  bool seen_free_ = false;  ///< the switch, since arming last ended
  bool ended_ = false;
  Stamp arming_since_{};
  Stamp next_load_{};
  std::optional<servo::ThrowerState> told_state_;
  std::string told_abort_;
  bool told_release_ = false;
  std::string told_problem_ = "not asked yet";
  long known_orders_ = 0;
  std::string told_refusal_;
  Stamp next_refusal_{};
};

}  // namespace hogline
