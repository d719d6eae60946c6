#include "src/team/link_end.hpp"

#include "hw/link/link_config.hpp"

namespace hogline {

LinkEnd::LinkEnd(hw::TeamLink& link, const std::string& self, const std::string& peer)
    : link_(link), peer_(peer), watch_({.self = self, .peers = {peer}, .silent_after = hw::link::heartbeat_deadline}) {}

void LinkEnd::step(Stamp now) {
  if (now < next_heartbeat_) return;
  next_heartbeat_ = now + hw::link::heartbeat_period;
  hw::HeartbeatMessage heartbeat;
  heartbeat.echoes = watch_.echoes();
  link_.send(heartbeat, now);
}

std::optional<hw::ReceivedMessage> LinkEnd::receive(Stamp now) {
  auto received = link_.receive(now);
  if (!received) return std::nullopt;
  if (const auto* heartbeat = std::get_if<hw::HeartbeatMessage>(&received->message)) {
    watch_.heard(*heartbeat, received->received, link_.team_time(received->received), session());
  }
  return received;
}

std::optional<Stamp> LinkEnd::local(hw::TeamTime theirs, Stamp now) const {
  const auto clock = watch_.peer(peer_, now).clock;
  if (!clock) return std::nullopt;
  return now + (theirs - clock->offset - link_.team_time(now));
}

}  // namespace hogline
