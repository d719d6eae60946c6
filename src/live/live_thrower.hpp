// A thrower that stays: it waits for orders over the team's link, throws them, tells when the stone is free, and after
// each throw or fault stands without power until its operator arms it again.
//
// Arming is pressing the switch: it must have been seen free and then held. An arming is good for one throw. Whatever
// goes wrong (a device, a silent peer, a called stop, the switch let go) ends it, and nothing moves before the next
// one.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hw/link/order_gate.hpp"
#include "src/config/thrower_rig.hpp"
#include "src/live/team_post.hpp"
#include "src/throwing/thrower_loop.hpp"
#include "src/throwing/vision_thread.hpp"

namespace hogline {

enum class LivePhase { disarmed, arming, armed, throwing };

const char* to_string(LivePhase phase);

/// Used by one thread, which also steps the devices through it.
class LiveThrower {
 public:
  /// Who looks at the pictures of one throw.
  using MakeSeer = std::function<std::unique_ptr<SheetSeer>()>;
  /// Told what happens, in a word and in words.
  using Tell = std::function<void(const char* event, const std::string& what)>;

  /// The rig has a link. Devices, link and clock must outlive it. Throws ConfigError where the rig names no commander.
  LiveThrower(const config::ThrowerRig& rig, const ThrowerDevices& devices, hw::TeamLink& link, MakeSeer make_seer,
              Tell tell);
  ~LiveThrower();
  LiveThrower(const LiveThrower&) = delete;
  LiveThrower& operator=(const LiveThrower&) = delete;

  /// One control period. `now` is the present time, `dt` the time since the last call.
  void step(Stamp now, Duration dt);
  /// As ThrowerLoop has them.
  std::optional<Stamp> release_due() const;
  void let_go(Stamp now);
  /// No order is taken any more, and a throw that is under way is ended: stop, with the stone held.
  void end(const std::string& why);

  LivePhase phase() const { return phase_; }
  /// Nothing moves, and nothing is about to.
  bool at_rest() const { return phase_ != LivePhase::throwing; }

 private:
  struct Throw;

  void watch_switch(Stamp now);
  bool held(Stamp now) const;
  void step_devices(Stamp now);
  void step_throw(Stamp now, Duration dt);
  void step_arming(Stamp now);
  void watch_armed(Stamp now);
  void hear(const hw::ReceivedMessage& received, Stamp now);
  void take_order(const hw::ShotOrderMessage& order, Stamp now);
  std::optional<std::string> not_now(const hw::ShotOrderMessage& order, Stamp now) const;
  void begin_throw(const hw::ShotOrderMessage& order, Stamp now);
  void tell_release(Stamp now);
  void end_throw();
  void disarm(const std::string& why);
  void rearm_devices();
  std::optional<std::string> not_ready(Stamp now) const;
  void publish(Stamp now);
  hw::ThrowerPhase wire_phase() const;
  void enter(LivePhase phase, const std::string& why);

  config::ThrowerRig rig_;
  ThrowerDevices devices_;
  TeamPost post_;
  hw::link::OrderGate gate_;
  MakeSeer make_seer_;
  Tell tell_;

  LivePhase phase_ = LivePhase::disarmed;
  std::string reason_;      ///< why it stands as it stands; empty: nothing to say
  bool fault_ = false;      ///< `reason_` is one
  bool seen_free_ = false;  ///< the switch, since arming last ended
  Stamp arming_since_{};
  Stamp next_rearm_{};
  std::uint64_t order_serial_ = 0;
  std::optional<std::string> ended_;  ///< why no order is taken any more
  std::unique_ptr<Throw> throw_;

  struct Published {
    hw::ThrowerPhase phase{};
    bool armed = false;
    std::uint64_t order_serial = 0;
    std::string reason;
    bool operator==(const Published&) const = default;
  };
  Published published_;
  Stamp published_at_{};
};

}  // namespace hogline
