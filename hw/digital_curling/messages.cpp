#include "hw/digital_curling/messages.hpp"

#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "servo/game/rules.hpp"

namespace hogline::hw::digital_curling {
namespace {

using nlohmann::json;
using namespace servo;

constexpr std::array<const char*, team_count> keys{"team0", "team1"};

json name_of(const std::optional<Team>& team) { return team ? json(team_name(*team)) : json(nullptr); }

template <class Value>
json number_or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

/// One entry a team.
template <class Each>
json teams(const Each& each) {
  json both;
  for (const std::size_t side : {0u, 1u}) both[keys[side]] = each(side);
  return both;
}

json stone_or_null(const std::optional<BoardStone>& stone) {
  if (!stone) return nullptr;
  assert(std::isfinite(stone->x_m) && std::isfinite(stone->y_m) && std::isfinite(stone->angle_rad));
  return {{"position", {{"x", stone->x_m}, {"y", stone->y_m}}}, {"angle", stone->angle_rad}};
}

json board_json(const Board& board) {
  return teams([&](std::size_t side) {
    json stones = json::array();
    for (const auto& stone : board.stones[side]) stones.push_back(stone_or_null(stone));
    return stones;
  });
}

json move_json(const GameMove& move) {
  const auto* shot = std::get_if<HackShot>(&move);
  if (!shot) return {{"type", "concede"}};
  return {{"type", "shot"},
          {"velocity", {{"x", shot->vx_mps}, {"y", shot->vy_mps}}},
          {"rotation", shot->curl == Curl::clockwise ? "cw" : "ccw"}};
}

json result_json(const std::optional<GameResult>& result) {
  if (!result) return nullptr;
  constexpr std::array<const char*, 4> reasons{"score", "concede", "time_limit", "draw"};
  return {{"winner", name_of(result->winner)}, {"reason", reasons[static_cast<std::size_t>(result->reason)]}};
}

json state_json(const GameState& state) {
  const auto scores = [&](std::size_t side) {
    json ends = json::array();
    for (const auto& end : state.scores[side]) ends.push_back(number_or_null(end));
    return ends;
  };
  return {{"end", state.end},
          {"shot", state.shot},
          {"hammer", name_of(state.hammer)},
          {"stones", board_json(state.board)},
          {"scores", teams(scores)},
          {"extra_end_score", teams([&](std::size_t side) { return number_or_null(state.extra_score[side]); })},
          {"thinking_time_remaining", teams([&](std::size_t side) { return seconds(state.thinking_left[side]); })},
          {"game_result", result_json(state.result)}};
}

json trajectory_json(const Trajectory& trajectory) {
  json frames = json::array();
  for (const auto& changes : trajectory.frames) {
    json frame = json::array();
    for (const StoneChange& change : changes) {
      frame.push_back(
          {{"team", team_name(change.team)}, {"index", change.stone}, {"value", stone_or_null(change.now)}});
    }
    frames.push_back(std::move(frame));
  }
  return {{"seconds_per_frame", trajectory.seconds_per_frame},
          {"start", board_json(trajectory.start)},
          {"finish", board_json(trajectory.finish)},
          {"frames", std::move(frames)}};
}

json last_move_json(const std::optional<LastMove>& last, bool with_trajectory) {
  if (!last) return nullptr;
  json said{{"actual_move", move_json(last->move)}, {"free_guard_zone_foul", last->free_guard_zone_foul}};
  if (with_trajectory && last->trajectory) said["trajectory"] = trajectory_json(*last->trajectory);
  return said;
}

json player_json(const PlayerSkill& skill) {
  return {{"type", "normal_dist"},
          {"max_speed", skill.max_speed_mps},
          {"stddev_speed", skill.speed_sigma_mps},
          {"stddev_angle", skill.angle_sigma_rad},
          {"seed", nullptr}};
}

json setting_json(const GameSetting& setting) {
  const double none_m = 1000.0;  // the protocol knows no sheet without sidelines
  return {{"max_end", setting.ends},
          {"sheet_width", setting.sheet_width_m.value_or(none_m)},
          {"five_rock_rule", setting.protected_throws >= 5},
          {"thinking_time", teams([&](std::size_t side) { return seconds(setting.thinking[side]); })},
          {"extra_end_thinking_time", teams([&](std::size_t side) { return seconds(setting.extra_thinking[side]); })}};
}

}  // namespace

std::string_view team_name(Team team) { return keys[side_of(team)]; }

std::string dc_message(const GameIdentity& identity) {
  return json{{"cmd", "dc"},
              {"version", {{"major", identity.protocol_major}, {"minor", 0}}},
              {"game_id", identity.game_id},
              {"date_time", identity.date_time}}
      .dump();
}

std::string is_ready_message(const GameOffer& offer, std::optional<Team> team) {
  const auto players = [&](std::size_t side) { return json(4, player_json(offer.players[side])); };
  return json{{"cmd", "is_ready"},
              {"team", name_of(team)},
              {"game",
               {{"rule", "normal"},
                {"setting", setting_json(offer.setting)},
                {"simulator", {{"type", "fcv1"}, {"seconds_per_frame", 0.001}}},
                {"players", teams(players)}}}}
      .dump();
}

std::string new_game_message(const std::array<std::string, team_count>& names) {
  return json{{"cmd", "new_game"}, {"name", teams([&](std::size_t side) { return names[side]; })}}.dump();
}

std::string update_message(const GameUpdate& update, bool with_trajectory) {
  return json{{"cmd", "update"},
              {"next_team", name_of(next_team(update.state))},
              {"state", state_json(update.state)},
              {"last_move", last_move_json(update.last, with_trajectory)}}
      .dump();
}

std::string game_over_message() { return json{{"cmd", "game_over"}}.dump(); }

std::string dc_ok_record(Team team, std::string_view name) {
  return json{{"cmd", "dc_ok"}, {"name", name}, {"team", team_name(team)}}.dump();
}

std::string ready_ok_record(Team team, const std::array<int, 4>& player_order) {
  return json{{"cmd", "ready_ok"}, {"player_order", player_order}, {"team", team_name(team)}}.dump();
}

std::string move_record(Team team, const GameMove& move) {
  return json{{"cmd", "move"}, {"move", move_json(move)}, {"team", team_name(team)}}.dump();
}

}  // namespace hogline::hw::digital_curling
