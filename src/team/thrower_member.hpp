// The thrower as one of the team: takes orders from the link, throws, and tells what it does. It knows only ports.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "hw/link/order_gate.hpp"
#include "src/config/thrower_rig.hpp"
#include "src/team/link_end.hpp"
#include "src/throwing/thrower_loop.hpp"

namespace hogline {

/// An order is thrown once, by a robot that is ready: devices without error, a stone in the jaws, the switch held. The
/// run stops with the stone held when the commander falls silent or somebody presses the emergency stop.
class ThrowerMember {
 public:
  /// Makes the eyes of one throw.
  using Seers = std::function<std::unique_ptr<SheetSeer>()>;

  /// Devices and link must outlive it.
  ThrowerMember(const config::ThrowerRig& rig, const ThrowerDevices& devices, Seers seers, hw::TeamLink& link);

  /// One control period.
  void step(Stamp now, Duration dt);
  /// As ThrowerLoop's.
  std::optional<Stamp> release_due() const { return throwing() ? loop_->release_due() : std::nullopt; }
  void let_go(Stamp now) { loop_->let_go(now); }

  /// The operator's word that the robot stands in its place and a stone lies between the jaws: latched errors are
  /// cleared, a stop that was called before is over, and the jaws close. Precondition: !throwing().
  void load();
  bool throwing() const { return loop_ && !over_; }
  /// Why the last order was refused; empty when it was not.
  const std::string& refused() const { return last_refusal_; }
  /// How many orders came in, whatever became of them.
  long orders() const { return orders_; }
  /// Empty: an order would be thrown.
  std::string not_ready() const;
  /// Why nobody is there to order or to follow a throw; empty while somebody is.
  std::string missing(Stamp now) const { return link_.missing(now); }
  /// Of the throw under way, or of the last one.
  const ThrowerLoop* loop() const { return loop_.get(); }
  std::optional<Stamp> throw_began() const { return began_; }

 private:
  void listen(Stamp now);
  void know_commander(Stamp now);
  void take(const hw::ShotOrderMessage& order, Stamp now);
  void take(const hw::EmergencyStopMessage& stop);
  std::string called_stop() const;
  void begin(const hw::ShotOrderMessage& order, Stamp now);
  void stand_by(Stamp now);
  void run(Stamp now, Duration dt);
  void tell(Stamp now);
  void tell_release(Stamp now);
  hw::ThrowerPhase phase() const;

  config::ThrowerRig rig_;
  ThrowerDevices devices_;
  Seers seers_;
  LinkEnd link_;
  hw::link::OrderGate gate_;
  std::unique_ptr<SheetSeer> seer_;
  std::unique_ptr<ThrowerLoop> loop_;
  std::optional<Stamp> began_;
  bool over_ = false;
  bool release_told_ = false;
  bool loading_ = false;
  std::uint64_t order_serial_ = 0;
  std::uint64_t commander_session_ = 0;
  std::string refused_;       ///< why the commander's last order was, while nothing was thrown
  std::string last_refusal_;  ///< why the last order was, of whomever and whenever
  long orders_ = 0;
  std::map<std::string, std::string> stops_;  ///< in force: by whom, and why
  hw::ThrowerStateMessage told_;
  Stamp next_state_{};
};

}  // namespace hogline
