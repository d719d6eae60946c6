#include "src/live/team_post.hpp"

#include <algorithm>
#include <utility>

namespace hogline {

TeamPost::TeamPost(const hw::link::LinkConfig& config, hw::TeamLink& link)
    : config_(config),
      link_(link),
      watch_({.self = config.robot, .peers = config.peers, .silent_after = hw::link::heartbeat_deadline}) {}

std::vector<hw::ReceivedMessage> TeamPost::step(Stamp now) {
  std::vector<hw::ReceivedMessage> rest;
  while (auto received = link_.receive(now)) {
    if (const auto* heartbeat = std::get_if<hw::HeartbeatMessage>(&received->message)) {
      watch_.heard(*heartbeat, now, link_.team_time(now), link_.state().session);
    } else if (const auto* stop = std::get_if<hw::EmergencyStopMessage>(&received->message)) {
      hear_stop(*stop);
    } else {
      rest.push_back(std::move(*received));
    }
  }
  if (now >= next_beat_) {
    next_beat_ = std::max(next_beat_ + hw::link::heartbeat_period, now);
    hw::HeartbeatMessage heartbeat;
    heartbeat.echoes = watch_.echoes();
    link_.send(std::move(heartbeat), now);
  }
  return rest;
}

void TeamPost::hear_stop(const hw::EmergencyStopMessage& stop) {
  if (stop.pressed) {
    stops_[stop.origin.robot] = stop.reason;
  } else {
    stops_.erase(stop.origin.robot);
  }
}

std::optional<hw::DeviceError> TeamPost::trouble(Stamp now) const {
  using Kind = hw::DeviceErrorKind;
  if (link_.state().error) return link_.state().error;
  if (!stops_.empty()) {
    const auto& [robot, reason] = *stops_.begin();
    return hw::DeviceError{Kind::refused, "team link",
                           "stop called by " + robot + (reason.empty() ? "" : ": " + reason), now};
  }
  const std::string missing = watch_.missing(now);
  if (!missing.empty()) return hw::DeviceError{Kind::timeout, "team link", missing, now};
  return std::nullopt;
}

std::optional<Stamp> TeamPost::made_at(const hw::Origin& origin, Stamp now) const {
  if (std::ranges::find(config_.peers, origin.robot) == config_.peers.end()) return std::nullopt;
  const auto clock = watch_.peer(origin.robot, now).clock;
  if (!clock) return std::nullopt;
  return now - (link_.team_time(now) - (origin.stamp - clock->offset));
}

}  // namespace hogline
