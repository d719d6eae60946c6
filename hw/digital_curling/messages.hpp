// What the server of a Digital Curling game says, one line of JSON each, without the line's end. Metres, m/s, rad, and
// times in seconds; teams are "team0" (the first) and "team1".
//
// Source: the public protocol pages of Digital Curling 3. Its programs write and read times in seconds with a fraction.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "servo/game/game_update.hpp"

namespace hogline::hw::digital_curling {

/// What a client must be told to know which game this is.
struct GameIdentity {
  std::string game_id;    ///< a UUID
  std::string date_time;  ///< ISO 8601, as 2026-11-22T10:05:00+00:00
  int protocol_major = 1;
};

/// How a team throws: what its strategist may count on.
struct PlayerSkill {
  double max_speed_mps = 0.0;  ///< at the hack
  double speed_sigma_mps = 0.0;
  double angle_sigma_rad = 0.0;
};

struct GameOffer {
  servo::GameSetting setting;
  std::array<PlayerSkill, servo::team_count> players;
};

std::string_view team_name(Team team);

std::string dc_message(const GameIdentity& identity);
/// Without a team as the log has it.
std::string is_ready_message(const GameOffer& offer, std::optional<Team> team);
std::string new_game_message(const std::array<std::string, servo::team_count>& names);
/// Precondition: every place is finite.
std::string update_message(const servo::GameUpdate& update, bool with_trajectory = true);
std::string game_over_message();

/// What a client said, as the log has it: with the team that said it.
std::string dc_ok_record(Team team, std::string_view name);
std::string ready_ok_record(Team team, const std::array<int, 4>& player_order);
std::string move_record(Team team, const servo::GameMove& move);

}  // namespace hogline::hw::digital_curling
