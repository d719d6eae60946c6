// One message of each kind, to be bent.
#pragma once

#include <vector>

#include "hw/team_messages.hpp"

namespace hogline::hw::link::test {

inline Origin origin() {
  return {.robot = "skip", .session = 7, .serial = 3, .stamp = TeamTime{std::chrono::seconds{1'800'000'000}}};
}
inline ShotOrderMessage order() {
  return {
      .origin = origin(), .thrower_session = 11, .shot = 4, .speed_mps = 2.1, .heading_rad = -0.01, .spin_radps = -1.6};
}
inline ThrowerStateMessage thrower_state() {
  return {.origin = origin(), .phase = ThrowerPhase::running, .armed = true, .order_serial = 4, .reason = "of no kind"};
}
inline ReleaseMessage release() {
  return {.origin = origin(),
          .order_serial = 4,
          .hog_distance_m = 0.4,
          .lateral_m = -0.01,
          .speed_mps = 2.09,
          .heading_rad = 0.011,
          .spin_radps = 1.5};
}
inline BoardMessage board() {
  return {.origin = origin(),
          .ok = true,
          .reason = {},
          .stones = {{.x_m = 0.1, .y_m = -1.2, .covariance_m2 = {1e-5, -1e-6, 2e-5}, .team = "first"},
                     {.x_m = -0.7, .y_m = 3.2, .covariance_m2 = {1e-5, 0.0, 2e-5}, .team = "unknown"}}};
}
inline StoneTrackMessage track() {
  return {.origin = origin(),
          .order_serial = 4,
          .seen = true,
          .x_m = 0.3,
          .y_m = 14.0,
          .vx_mps = 0.01,
          .vy_mps = -1.7,
          .place_covariance_m2 = {1e-4, 2e-5, 3e-3},
          .velocity_covariance_m2ps2 = {1e-5, 0.0, 4e-4}};
}
inline OutcomeMessage outcome() {
  return {.origin = origin(),
          .order_serial = 4,
          .ok = true,
          .reason = {},
          .fate = "at_rest",
          .x_m = 0.02,
          .y_m = -0.3,
          .hog_to_hog_s = 13.9,
          .hog_to_rest_s = std::nullopt,
          .curl_m = -1.1,
          .collisions = 1};
}
inline HeartbeatMessage heartbeat() {
  return {.origin = origin(),
          .echoes = {{.robot = "thrower",
                      .session = 11,
                      .sent = TeamTime{std::chrono::seconds{1'800'000'001}},
                      .heard = TeamTime{std::chrono::seconds{1'800'000'002}}}}};
}
inline EmergencyStopMessage emergency_stop() {
  return {.origin = origin(), .pressed = true, .reason = "the mushroom on the head"};
}

inline std::vector<TeamMessage> one_of_each() {
  return {order(), thrower_state(), release(), board(), track(), outcome(), heartbeat(), emergency_stop()};
}

template <typename Message, typename Bend>
TeamMessage with(Message message, Bend bend) {
  bend(message);
  return message;
}

}  // namespace hogline::hw::link::test
