#include "hw/link/message_bounds.hpp"
#include "hw/link/wire_messages.hpp"
#include "hw/link/wire_values.hpp"

namespace hogline::hw::link {
namespace {

using Write = std::function<void(const void*)>;

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

}  // namespace

bool with_wire(const TeamMessage& message, const Write& write) {
  if (!within_bounds(message)) return false;
  std::visit([&](const auto& m) { write_as_wire(m, write); }, message);
  return true;
}

}  // namespace hogline::hw::link
