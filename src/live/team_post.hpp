// A robot's place on the team's link, once a control period: heartbeats out and in, who is there, whether anybody has
// called a stop, and what else came.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hw/device_status.hpp"
#include "hw/link/link_config.hpp"
#include "hw/link/team_watch.hpp"
#include "hw/team_link.hpp"

namespace hogline {

class TeamPost {
 public:
  /// The link must outlive the post.
  TeamPost(const hw::link::LinkConfig& config, hw::TeamLink& link);

  /// Hears everything and sends a heartbeat when one is due. Returns what came besides heartbeats and stops.
  std::vector<hw::ReceivedMessage> step(Stamp now);
  /// Why this robot may not move: the link is broken, a peer is not there, a stop is in force. Nothing if it may.
  std::optional<hw::DeviceError> trouble(Stamp now) const;
  /// The operator re-arms: stops that were called until now are no longer in force.
  void lift_stops() { stops_.clear(); }

  /// When a message was made, in our clock; nothing while the offset to its sender's is not known.
  std::optional<Stamp> made_at(const hw::Origin& origin, Stamp now) const;
  hw::link::PeerState peer(const std::string& robot, Stamp now) const { return watch_.peer(robot, now); }
  std::uint64_t session() const { return link_.state().session; }
  hw::TeamSendResult send(hw::TeamMessage message, Stamp at) { return link_.send(std::move(message), at); }

 private:
  void hear_stop(const hw::EmergencyStopMessage& stop);

  hw::link::LinkConfig config_;
  hw::TeamLink& link_;
  hw::link::TeamWatch watch_;
  Stamp next_beat_{};
  std::map<std::string, std::string> stops_;  ///< in force: who called it, and why
};

}  // namespace hogline
