#include "hw/link/team_watch.hpp"

#include <fmt/format.h>

#include <cassert>

namespace hogline::hw::link {

TeamWatch::TeamWatch(TeamWatchConfig config) : config_(std::move(config)) {
  for (const std::string& robot : config_.peers) peers_[robot];
}

void TeamWatch::heard(const HeartbeatMessage& heartbeat, Stamp received, TeamTime received_team,
                      std::uint64_t session) {
  const Origin& from = heartbeat.origin;
  const auto found = peers_.find(from.robot);
  if (found == peers_.end()) {
    ++strangers_;
    return;
  }
  Peer& peer = found->second;
  if (from.session < peer.session) return;
  if (from.session > peer.session) {
    if (peer.session != 0 && received - peer.received <= config_.silent_after) {
      ++rivals_;
      return;
    }
    peer = Peer{.session = from.session,
                .serial = from.serial - 1,
                .received = {},
                .echo = {},
                .clock = {},
                .restarts = peer.restarts + (peer.session == 0 ? 0 : 1),
                .missed = peer.missed};
  }
  if (from.serial <= peer.serial) return;
  peer.missed += static_cast<long>(from.serial - peer.serial - 1);
  peer.serial = from.serial;
  peer.received = received;
  peer.echo = {.robot = from.robot, .session = from.session, .sent = from.stamp, .heard = received_team};
  for (const Echo& echo : heartbeat.echoes) {
    if (echo.robot == config_.self && echo.session == session)
      peer.clock.add(echo.sent, echo.heard, from.stamp, received_team);
  }
}

PeerState TeamWatch::peer(const std::string& robot, Stamp now) const {
  const auto found = peers_.find(robot);
  assert(found != peers_.end());
  const Peer& peer = found->second;
  if (peer.session == 0) return {};
  const Duration age = now - peer.received;
  return {.presence = age > config_.silent_after ? Presence::silent : Presence::there,
          .session = peer.session,
          .age = age,
          .restarts = peer.restarts,
          .missed = peer.missed,
          .clock = peer.clock.estimate()};
}

std::string TeamWatch::missing(Stamp now) const {
  for (const auto& [robot, peer_is] : peers_) {
    const PeerState state = peer(robot, now);
    if (state.presence == Presence::unheard) return robot + ": not heard yet";
    if (state.presence == Presence::silent) return fmt::format("{}: silent for {:.1f} s", robot, seconds(state.age));
  }
  return {};
}

std::vector<Echo> TeamWatch::echoes() const {
  std::vector<Echo> echoes;
  for (const auto& [robot, peer] : peers_)
    if (peer.session != 0) echoes.push_back(peer.echo);
  return echoes;
}

}  // namespace hogline::hw::link
