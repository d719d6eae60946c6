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
  std::uint64_t peer_session(Stamp now) const { return watch_.peer(peer_, now).session; }
  /// A moment of the peer's clock in our own; nothing while the clocks' offset is not known.
  std::optional<Stamp> local(hw::TeamTime theirs, Stamp now) const;

 private:
  hw::TeamLink& link_;
  std::string peer_;
  hw::link::TeamWatch watch_;
  Stamp next_heartbeat_{};
};

}  // namespace hogline
