#include "src/team/link_end.hpp"

#include "hw/link/link_config.hpp"

namespace hogline {

LinkEnd::LinkEnd(hw::TeamLink& link, const std::string& self, const std::string& peer)
    : link_(link),
      self_(self),
      peer_(peer),
      watch_({.self = self, .peers = {peer}, .silent_after = hw::link::heartbeat_deadline}) {}

void LinkEnd::step(Stamp now) {
  if (now < next_heartbeat_) return;
  next_heartbeat_ = now + hw::link::heartbeat_period;
  hw::HeartbeatMessage heartbeat;
  heartbeat.echoes = watch_.echoes();
  if (const std::uint64_t peer = peer_session(now); peer != echoed_session_) {
    echoed_session_ = peer;
    echoed_since_ = link_.team_time(now);
    answered_ = false;
  }
  link_.send(heartbeat, now);
}

std::optional<hw::ReceivedMessage> LinkEnd::receive(Stamp now) {
  auto received = link_.receive(now);
  if (!received) return std::nullopt;
  if (const auto* heartbeat = std::get_if<hw::HeartbeatMessage>(&received->message)) {
    watch_.heard(*heartbeat, received->received, link_.team_time(received->received), session());
    take(*heartbeat);
  }
  return received;
}

// An echo of a heartbeat of ours that carried an echo itself: with that one the peer has our clock.
void LinkEnd::take(const hw::HeartbeatMessage& heartbeat) {
  if (heartbeat.origin.robot != peer_ || heartbeat.origin.session != echoed_session_) return;
  for (const hw::Echo& echo : heartbeat.echoes)
    if (echo.robot == self_ && echo.session == session() && echo.sent >= echoed_since_) answered_ = true;
}

bool LinkEnd::answered(Stamp now) const {
  return answered_ && missing(now).empty() && peer_session(now) == echoed_session_;
}

std::optional<Stamp> LinkEnd::local(hw::TeamTime theirs, Stamp now) const {
  const auto clock = watch_.peer(peer_, now).clock;
  if (!clock) return std::nullopt;
  return now + (theirs - clock->offset - link_.team_time(now));
}

}  // namespace hogline
