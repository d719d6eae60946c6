// One robot's end of the team's link: heartbeats, who is there, and others' times in its own clock.
#pragma once

#include <optional>
#include <string>

#include "hw/link/team_watch.hpp"
#include "hw/team_link.hpp"

namespace hogline {

class LinkEnd {
 public:
  /// The link must outlive it.
  LinkEnd(hw::TeamLink& link, const std::string& self, const std::string& peer);

  /// Sends a heartbeat where one is due.
  void step(Stamp now);
  /// The oldest message not yet read; heartbeats have been taken in.
  std::optional<hw::ReceivedMessage> receive(Stamp now);
  hw::TeamSendResult send(const hw::TeamMessage& message, Stamp at) { return link_.send(message, at); }

  std::uint64_t session() const { return link_.state().session; }
  /// Why the peer is not to be relied on; empty while it is there.
  std::string missing(Stamp now) const { return watch_.missing(now); }
  /// The peer, as it is now, has told that it hears us and no other of our name, and that it can place our times in its
  /// clock: what it is sent will be read as ours.
  bool answered(Stamp now) const;
  std::uint64_t peer_session(Stamp now) const { return watch_.peer(peer_, now).session; }
  /// A moment of the peer's clock in our own; nothing while the clocks' offset is not known.
  std::optional<Stamp> local(hw::TeamTime theirs, Stamp now) const;

 private:
  void take(const hw::HeartbeatMessage& heartbeat);

  hw::TeamLink& link_;
  std::string self_;
  std::string peer_;
  hw::link::TeamWatch watch_;
  Stamp next_heartbeat_{};
  std::uint64_t echoed_session_ = 0;  ///< of the peer, which our heartbeats repeat
  hw::TeamTime echoed_since_{};
  bool answered_ = false;
};

}  // namespace hogline
