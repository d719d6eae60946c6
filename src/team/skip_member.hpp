// The skip as one of the team: looks at the house, orders the shot, follows the stone, and tells what it sees. It knows
// only ports.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/config/skip_rig.hpp"
#include "src/skip/skip_loop.hpp"
#include "src/team/link_end.hpp"

namespace hogline {

/// What has become of the order.
enum class OrderPhase {
  none,      ///< nothing was ordered since begin()
  sent,      ///< or about to be, once the thrower answers to us; not answered
  throwing,  ///< the thrower has taken it
  released,  ///< the stone is free
  refused,   ///< or stopped before the release: the stone has not been thrown
};

class SkipMember {
 public:
  /// Makes the eyes of one throw.
  using Seers = std::function<std::unique_ptr<SkipSeer>()>;

  /// Devices and link must outlive it.
  SkipMember(const config::SkipRig& rig, const SkipDevices& devices, Seers seers, hw::TeamLink& link);

  /// One control period.
  void step(Stamp now, Duration dt);

  /// Looks at sheet and standing stones, then waits for a stone. `ice`: in s. Whatever was under way ends.
  void begin(const servo::IceEstimate& ice, Stamp now);
  /// Sheet and standing stones have been seen.
  bool has_looked() const;
  /// ... and the head points at where the stone will come from.
  bool waits() const;
  /// Nothing more will come of this throw.
  bool over() const { return loop_ && loop_->skip().finished(); }
  /// Precondition: begun.
  const servo::Skip& skip() const { return loop_->skip(); }
  const SkipLoop* loop() const { return loop_.get(); }
  /// Why no thrower is there to order from; empty while it is.
  std::string missing(Stamp now) const { return link_.missing(now); }

  /// By its own word: its operator holds the switch.
  bool thrower_armed(Stamp now) const;

  /// Precondition: has_looked(). `shot`: of the end, from 1; `team`: whose stone it is. A thrower that does not yet
  /// answer to us, because one of us was just started, is waited for; then the order is refused.
  void order(const servo::ShotOrder& order, std::uint32_t shot, Team team, Stamp now);
  OrderPhase ordered() const { return ordered_; }
  /// It is on its way: what becomes of it is not known yet.
  bool order_is_open() const;
  /// Why, when refused.
  const std::string& why() const { return why_; }
  /// What the thrower told of the release of this order.
  const std::optional<hw::ReleaseMessage>& release() const { return release_; }
  /// When it was, in our clock.
  std::optional<Stamp> released_at() const { return released_at_; }

 private:
  void send_order(Stamp now);
  void listen(Stamp now);
  void take(const hw::ThrowerStateMessage& state);
  void take(const hw::ReleaseMessage& release, Stamp now);
  void tell(Stamp now);
  void tell_board(Stamp now);
  void tell_track(Stamp now);
  void tell_outcome(Stamp now);
  void stop_thrower(bool pressed, const std::string& reason, Stamp now);

  config::SkipRig rig_;
  SkipDevices devices_;
  Seers seers_;
  LinkEnd link_;
  std::unique_ptr<SkipSeer> seer_;
  std::unique_ptr<SkipLoop> loop_;
  /// An order that waits to be sent.
  struct Held {
    hw::ShotOrderMessage message;
    Stamp since{};
  };
  std::optional<Held> held_;
  std::optional<hw::ThrowerStateMessage> thrower_;  ///< as it told last
  OrderPhase ordered_ = OrderPhase::none;
  std::string why_;
  std::optional<hw::ReleaseMessage> release_;
  std::optional<Stamp> released_at_;
  Team team_ = Team::unknown;
  std::uint64_t orders_ = 0;           ///< sent since the start: the serial of the last
  std::uint64_t thrower_session_ = 0;  ///< to which it was sent: a later start knows nothing of it
  bool stopping_ = false;              ///< an emergency stop of ours is in force
  bool board_told_ = false;
  bool outcome_told_ = false;
  Stamp next_track_{};
};

}  // namespace hogline
