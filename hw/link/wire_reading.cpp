#include "hw/link/message_bounds.hpp"
#include "hw/link/wire_messages.hpp"
#include "hw/link/wire_values.hpp"

namespace hogline::hw::link {
namespace {

// A message with its origin and what `take` reads of the rest, if all of it can be read and keeps its bounds.
template <typename Message, typename Wire, typename Take>
std::optional<TeamMessage> read(const Wire& wire, Take take) {
  const auto origin = plain_origin(wire.origin, wire.header.stamp);
  if (!origin) return std::nullopt;
  Message message;
  message.origin = *origin;
  if (!take(message)) return std::nullopt;
  TeamMessage whole(std::move(message));
  if (!within_bounds(whole)) return std::nullopt;
  return whole;
}

// False: no text, or too long.
bool take_text(const char* wire, std::size_t longest, std::string& text) {
  auto plain = plain_text(wire, longest);
  if (plain) text = std::move(*plain);
  return plain.has_value();
}

bool take_time(const builtin_interfaces_msg_dds__Time_& wire, TeamTime& time) {
  const auto plain = plain_time(wire);
  if (plain) time = *plain;
  return plain.has_value();
}

bool take_stone(const hogline_msgs_msg_dds__Stone_& wire, TeamStone& stone) {
  stone.x_m = wire.position.x;
  stone.y_m = wire.position.y;
  stone.covariance_m2 = {wire.covariance[0], wire.covariance[1], wire.covariance[2]};
  return take_text(wire.team, longest_name, stone.team);
}

bool take_echo(const hogline_msgs_msg_dds__Echo_& wire, Echo& echo) {
  echo.session = wire.session;
  return take_text(wire.robot, longest_name, echo.robot) && take_time(wire.sent, echo.sent) &&
         take_time(wire.heard, echo.heard);
}

std::optional<double> measured(double seconds_or_minus_1) {
  return seconds_or_minus_1 == -1.0 ? std::nullopt : std::optional(seconds_or_minus_1);
}

}  // namespace

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__ShotOrder_& wire) {
  return read<ShotOrderMessage>(wire, [&](ShotOrderMessage& m) {
    m.thrower_session = wire.thrower_session;
    m.shot = wire.shot;
    m.speed_mps = wire.speed_mps;
    m.heading_rad = wire.heading_rad;
    m.spin_radps = wire.spin_radps;
    return true;
  });
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__ThrowerState_& wire) {
  return read<ThrowerStateMessage>(wire, [&](ThrowerStateMessage& m) {
    m.phase = static_cast<ThrowerPhase>(wire.phase);
    m.armed = wire.armed;
    m.order_serial = wire.order_serial;
    return wire.phase <= static_cast<std::uint8_t>(ThrowerPhase::fault) &&
           take_text(wire.reason, longest_text, m.reason);
  });
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Release_& wire) {
  return read<ReleaseMessage>(wire, [&](ReleaseMessage& m) {
    m.order_serial = wire.order_serial;
    m.hog_distance_m = wire.hog_distance_m;
    m.lateral_m = wire.lateral_m;
    m.speed_mps = wire.speed_mps;
    m.heading_rad = wire.heading_rad;
    m.spin_radps = wire.spin_radps;
    return true;
  });
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Board_& wire) {
  return read<BoardMessage>(wire, [&](BoardMessage& m) {
    m.ok = wire.ok;
    if (wire.stones._length > most_stones || !take_text(wire.reason, longest_text, m.reason)) return false;
    m.stones.resize(wire.stones._length);
    for (std::uint32_t i = 0; i < wire.stones._length; ++i)
      if (!take_stone(wire.stones._buffer[i], m.stones[i])) return false;
    return true;
  });
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__StoneTrack_& wire) {
  return read<StoneTrackMessage>(wire, [&](StoneTrackMessage& m) {
    m.order_serial = wire.order_serial;
    m.seen = wire.seen;
    m.x_m = wire.pose.pose.position.x;
    m.y_m = wire.pose.pose.position.y;
    m.vx_mps = wire.twist.twist.linear.x;
    m.vy_mps = wire.twist.twist.linear.y;
    m.place_covariance_m2 = covariance_of(wire.pose.covariance);
    m.velocity_covariance_m2ps2 = covariance_of(wire.twist.covariance);
    return true;
  });
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Outcome_& wire) {
  return read<OutcomeMessage>(wire, [&](OutcomeMessage& m) {
    m.order_serial = wire.order_serial;
    m.ok = wire.ok;
    m.x_m = wire.position.x;
    m.y_m = wire.position.y;
    m.hog_to_hog_s = measured(wire.hog_to_hog_s);
    m.hog_to_rest_s = measured(wire.hog_to_rest_s);
    if (wire.curl_measured) m.curl_m = wire.curl_m;
    m.collisions = wire.collisions;
    return take_text(wire.reason, longest_text, m.reason) && take_text(wire.fate, longest_name, m.fate);
  });
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Heartbeat_& wire) {
  return read<HeartbeatMessage>(wire, [&](HeartbeatMessage& m) {
    if (wire.echoes._length > most_echoes) return false;
    m.echoes.resize(wire.echoes._length);
    for (std::uint32_t i = 0; i < wire.echoes._length; ++i)
      if (!take_echo(wire.echoes._buffer[i], m.echoes[i])) return false;
    return true;
  });
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__EmergencyStop_& wire) {
  return read<EmergencyStopMessage>(wire, [&](EmergencyStopMessage& m) {
    m.pressed = wire.pressed;
    return take_text(wire.reason, longest_text, m.reason);
  });
}

}  // namespace hogline::hw::link
