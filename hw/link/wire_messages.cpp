#include "hw/link/wire_messages.hpp"

#include "hw/link/message_bounds.hpp"
#include "hw/link/wire_values.hpp"

namespace hogline::hw::link {
namespace {

using Write = std::function<void(const void*)>;

// Rows and columns of x and y in a ROS 2 covariance of six.
constexpr std::size_t xx = 0;
constexpr std::size_t xy = 1;
constexpr std::size_t yx = 6;
constexpr std::size_t yy = 7;

void put_covariance(double (&wire)[36], const std::array<double, 3>& covariance) {
  wire[xx] = covariance[0];
  wire[xy] = wire[yx] = covariance[1];
  wire[yy] = covariance[2];
}

std::array<double, 3> covariance_of(const double (&wire)[36]) { return {wire[xx], wire[xy], wire[yy]}; }

void write_as_wire(const ShotOrderMessage& m, const Write& write) {
  const hogline_msgs_msg_dds__ShotOrder_ wire{.header = wire_header(m.origin, "e"),
                                              .origin = wire_origin(m.origin),
                                              .thrower_session = m.thrower_session,
                                              .shot = m.shot,
                                              .speed_mps = m.speed_mps,
                                              .heading_rad = m.heading_rad,
                                              .spin_radps = m.spin_radps};
  write(&wire);
}

void write_as_wire(const ThrowerStateMessage& m, const Write& write) {
  const hogline_msgs_msg_dds__ThrowerState_ wire{.header = wire_header(m.origin, ""),
                                                 .origin = wire_origin(m.origin),
                                                 .phase = static_cast<std::uint8_t>(m.phase),
                                                 .armed = m.armed,
                                                 .order_serial = m.order_serial,
                                                 .reason = wire_text(m.reason)};
  write(&wire);
}

void write_as_wire(const ReleaseMessage& m, const Write& write) {
  const hogline_msgs_msg_dds__Release_ wire{.header = wire_header(m.origin, "e"),
                                            .origin = wire_origin(m.origin),
                                            .order_serial = m.order_serial,
                                            .hog_distance_m = m.hog_distance_m,
                                            .lateral_m = m.lateral_m,
                                            .speed_mps = m.speed_mps,
                                            .heading_rad = m.heading_rad,
                                            .spin_radps = m.spin_radps};
  write(&wire);
}

void write_as_wire(const BoardMessage& m, const Write& write) {
  std::vector<hogline_msgs_msg_dds__Stone_> stones;
  for (const TeamStone& s : m.stones) {
    stones.push_back({.position = {.x = s.x_m, .y = s.y_m, .z = 0.0},
                      .covariance = {s.covariance_m2[0], s.covariance_m2[1], s.covariance_m2[2]},
                      .team = wire_text(s.team)});
  }
  const auto count = static_cast<std::uint32_t>(stones.size());
  const hogline_msgs_msg_dds__Board_ wire{
      .header = wire_header(m.origin, "e"),
      .origin = wire_origin(m.origin),
      .ok = m.ok,
      .reason = wire_text(m.reason),
      .stones = {._maximum = count, ._length = count, ._buffer = stones.data(), ._release = false}};
  write(&wire);
}

void write_as_wire(const StoneTrackMessage& m, const Write& write) {
  hogline_msgs_msg_dds__StoneTrack_ wire{};
  wire.header = wire_header(m.origin, "e");
  wire.origin = wire_origin(m.origin);
  wire.order_serial = m.order_serial;
  wire.seen = m.seen;
  wire.pose.pose.position = {.x = m.x_m, .y = m.y_m, .z = 0.0};
  wire.pose.pose.orientation.w = 1.0;
  put_covariance(wire.pose.covariance, m.place_covariance_m2);
  wire.twist.twist.linear = {.x = m.vx_mps, .y = m.vy_mps, .z = 0.0};
  put_covariance(wire.twist.covariance, m.velocity_covariance_m2ps2);
  write(&wire);
}

void write_as_wire(const OutcomeMessage& m, const Write& write) {
  const hogline_msgs_msg_dds__Outcome_ wire{.header = wire_header(m.origin, "e"),
                                            .origin = wire_origin(m.origin),
                                            .order_serial = m.order_serial,
                                            .ok = m.ok,
                                            .reason = wire_text(m.reason),
                                            .fate = wire_text(m.fate),
                                            .position = {.x = m.x_m, .y = m.y_m, .z = 0.0},
                                            .hog_to_hog_s = m.hog_to_hog_s.value_or(-1.0),
                                            .hog_to_rest_s = m.hog_to_rest_s.value_or(-1.0),
                                            .curl_measured = m.curl_m.has_value(),
                                            .curl_m = m.curl_m.value_or(0.0),
                                            .collisions = m.collisions};
  write(&wire);
}

void write_as_wire(const HeartbeatMessage& m, const Write& write) {
  std::vector<hogline_msgs_msg_dds__Echo_> echoes;
  for (const Echo& e : m.echoes) {
    echoes.push_back(
        {.robot = wire_text(e.robot), .session = e.session, .sent = wire_time(e.sent), .heard = wire_time(e.heard)});
  }
  const auto count = static_cast<std::uint32_t>(echoes.size());
  const hogline_msgs_msg_dds__Heartbeat_ wire{
      .header = wire_header(m.origin, ""),
      .origin = wire_origin(m.origin),
      .echoes = {._maximum = count, ._length = count, ._buffer = echoes.data(), ._release = false}};
  write(&wire);
}

void write_as_wire(const EmergencyStopMessage& m, const Write& write) {
  const hogline_msgs_msg_dds__EmergencyStop_ wire{.header = wire_header(m.origin, ""),
                                                  .origin = wire_origin(m.origin),
                                                  .pressed = m.pressed,
                                                  .reason = wire_text(m.reason)};
  write(&wire);
}

// The message if it keeps its bounds.
std::optional<TeamMessage> bounded(TeamMessage message) {
  if (!within_bounds(message)) return std::nullopt;
  return message;
}

std::optional<double> measured(double seconds_or_minus_1) {
  return seconds_or_minus_1 == -1.0 ? std::nullopt : std::optional(seconds_or_minus_1);
}

}  // namespace

bool with_wire(const TeamMessage& message, const Write& write) {
  if (!within_bounds(message)) return false;
  std::visit([&](const auto& m) { write_as_wire(m, write); }, message);
  return true;
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__ShotOrder_& wire) {
  const auto origin = plain_origin(wire.origin, wire.header.stamp);
  if (!origin) return std::nullopt;
  return bounded(ShotOrderMessage{.origin = *origin,
                                  .thrower_session = wire.thrower_session,
                                  .shot = wire.shot,
                                  .speed_mps = wire.speed_mps,
                                  .heading_rad = wire.heading_rad,
                                  .spin_radps = wire.spin_radps});
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__ThrowerState_& wire) {
  const auto origin = plain_origin(wire.origin, wire.header.stamp);
  const auto reason = plain_text(wire.reason, longest_text);
  if (!origin || !reason || wire.phase > static_cast<std::uint8_t>(ThrowerPhase::fault)) return std::nullopt;
  return bounded(ThrowerStateMessage{.origin = *origin,
                                     .phase = static_cast<ThrowerPhase>(wire.phase),
                                     .armed = wire.armed,
                                     .order_serial = wire.order_serial,
                                     .reason = *reason});
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Release_& wire) {
  const auto origin = plain_origin(wire.origin, wire.header.stamp);
  if (!origin) return std::nullopt;
  return bounded(ReleaseMessage{.origin = *origin,
                                .order_serial = wire.order_serial,
                                .hog_distance_m = wire.hog_distance_m,
                                .lateral_m = wire.lateral_m,
                                .speed_mps = wire.speed_mps,
                                .heading_rad = wire.heading_rad,
                                .spin_radps = wire.spin_radps});
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Board_& wire) {
  const auto origin = plain_origin(wire.origin, wire.header.stamp);
  const auto reason = plain_text(wire.reason, longest_text);
  if (!origin || !reason || wire.stones._length > most_stones) return std::nullopt;
  BoardMessage board{.origin = *origin, .ok = wire.ok, .reason = *reason, .stones = {}};
  for (std::uint32_t i = 0; i < wire.stones._length; ++i) {
    const auto& stone = wire.stones._buffer[i];
    const auto team = plain_text(stone.team, longest_name);
    if (!team) return std::nullopt;
    board.stones.push_back({.x_m = stone.position.x,
                            .y_m = stone.position.y,
                            .covariance_m2 = {stone.covariance[0], stone.covariance[1], stone.covariance[2]},
                            .team = *team});
  }
  return bounded(std::move(board));
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__StoneTrack_& wire) {
  const auto origin = plain_origin(wire.origin, wire.header.stamp);
  if (!origin) return std::nullopt;
  return bounded(StoneTrackMessage{.origin = *origin,
                                   .order_serial = wire.order_serial,
                                   .seen = wire.seen,
                                   .x_m = wire.pose.pose.position.x,
                                   .y_m = wire.pose.pose.position.y,
                                   .vx_mps = wire.twist.twist.linear.x,
                                   .vy_mps = wire.twist.twist.linear.y,
                                   .place_covariance_m2 = covariance_of(wire.pose.covariance),
                                   .velocity_covariance_m2ps2 = covariance_of(wire.twist.covariance)});
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Outcome_& wire) {
  const auto origin = plain_origin(wire.origin, wire.header.stamp);
  const auto reason = plain_text(wire.reason, longest_text);
  const auto fate = plain_text(wire.fate, longest_name);
  if (!origin || !reason || !fate) return std::nullopt;
  return bounded(OutcomeMessage{.origin = *origin,
                                .order_serial = wire.order_serial,
                                .ok = wire.ok,
                                .reason = *reason,
                                .fate = *fate,
                                .x_m = wire.position.x,
                                .y_m = wire.position.y,
                                .hog_to_hog_s = measured(wire.hog_to_hog_s),
                                .hog_to_rest_s = measured(wire.hog_to_rest_s),
                                .curl_m = wire.curl_measured ? std::optional(wire.curl_m) : std::nullopt,
                                .collisions = wire.collisions});
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__Heartbeat_& wire) {
  const auto origin = plain_origin(wire.origin, wire.header.stamp);
  if (!origin || wire.echoes._length > most_echoes) return std::nullopt;
  HeartbeatMessage heartbeat{.origin = *origin, .echoes = {}};
  for (std::uint32_t i = 0; i < wire.echoes._length; ++i) {
    const auto& echo = wire.echoes._buffer[i];
    const auto robot = plain_text(echo.robot, longest_name);
    const auto sent = plain_time(echo.sent);
    const auto heard = plain_time(echo.heard);
    if (!robot || !sent || !heard) return std::nullopt;
    heartbeat.echoes.push_back({.robot = *robot, .session = echo.session, .sent = *sent, .heard = *heard});
  }
  return bounded(std::move(heartbeat));
}

std::optional<TeamMessage> plain(const hogline_msgs_msg_dds__EmergencyStop_& wire) {
  const auto origin = plain_origin(wire.origin, wire.header.stamp);
  const auto reason = plain_text(wire.reason, longest_text);
  if (!origin || !reason) return std::nullopt;
  return bounded(EmergencyStopMessage{.origin = *origin, .pressed = wire.pressed, .reason = *reason});
}

}  // namespace hogline::hw::link
