#include "servo/game/rules.hpp"

#include <cassert>
#include <cmath>
#include <numeric>

namespace hogline::servo {
namespace {

struct Throw {
  Team team;
  std::size_t stone;
};

/// Why these stones can not have come of that throw.
std::string impossible(const GameState& before, const Throw& thrown, const Board& lying) {
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < stones_each; ++i) {
      const auto& stone = lying.stones[side][i];
      if (!stone) continue;
      if (!std::isfinite(stone->x_m) || !std::isfinite(stone->y_m) || !std::isfinite(stone->angle_rad))
        return "a stone's place is not finite";
      const bool is_thrown = side == side_of(thrown.team) && i == thrown.stone;
      if (!is_thrown && !before.board.stones[side][i]) return "a stone lies there that was not in play";
    }
  }
  return {};
}

std::optional<OutOfPlay> out_of_play(const BoardStone& stone, const GameSetting& setting) {
  if (setting.sheet_width_m && touches_sideline(stone, *setting.sheet_width_m)) return OutOfPlay::sideline;
  if (past_back_line(stone)) return OutOfPlay::through;
  return std::nullopt;
}

std::vector<Removal> clear(Board& board, const Throw& thrown, bool struck, const GameSetting& setting) {
  std::vector<Removal> removed;
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < stones_each; ++i) {
      auto& stone = board.stones[side][i];
      if (!stone) continue;
      auto why = out_of_play(*stone, setting);
      const bool is_thrown = side == side_of(thrown.team) && i == thrown.stone;
      if (is_thrown && !struck && !past_hog_line(*stone)) why = OutOfPlay::hogged;
      if (!why) continue;
      removed.push_back({team_of(side), i, *why});
      stone.reset();
    }
  }
  return removed;
}

bool freed_a_guard(const GameState& before, const Board& after, Team thrower, const GameSetting& setting) {
  if (before.shot >= setting.protected_throws) return false;
  const std::size_t side = side_of(opponent_of(thrower));
  for (std::size_t i = 0; i < stones_each; ++i) {
    const auto& guard = before.board.stones[side][i];
    if (guard && in_free_guard_zone(*guard) && !after.stones[side][i]) return true;
  }
  return false;
}

void write_down(GameState& state, const EndScore& points, const GameSetting& setting) {
  for (const std::size_t side : {0u, 1u}) {
    if (state.end < setting.ends)
      state.scores[side][static_cast<std::size_t>(state.end)] = points[side];
    else if (points[0] != points[1])
      state.extra_score[side] = points[side];
    if (points[side] > 0) state.hammer = opponent_of(team_of(side));
  }
}

void finish(GameState& state, std::optional<Team> winner, GameReason reason) {
  state.result = GameResult{winner, reason};
  state.hammer.reset();
}

void begin_end(GameState& state, const GameSetting& setting) {
  state.board = {};
  state.shot = 0;
  ++state.end;
  if (state.end < setting.ends) return;
  const int lead = total(state, Team::first) - total(state, Team::second);
  if (lead != 0)
    finish(state, lead > 0 ? Team::first : Team::second, GameReason::score);
  else if (state.end >= setting.most_ends)
    finish(state, std::nullopt, GameReason::draw);
  else
    state.thinking_left = setting.extra_thinking;
}

}  // namespace

GameState new_game(const GameSetting& setting) {
  assert(setting.ends >= 1);
  GameState state;
  state.hammer = setting.first_hammer;
  for (auto& scores : state.scores) scores.resize(static_cast<std::size_t>(setting.ends));
  state.thinking_left = setting.thinking;
  return state;
}

std::optional<Team> next_team(const GameState& state) {
  if (state.result || !state.hammer) return std::nullopt;
  return state.shot % team_count == 0 ? opponent_of(*state.hammer) : *state.hammer;
}

int total(const GameState& state, Team team) {
  const auto& ends = state.scores[side_of(team)];
  return std::accumulate(ends.begin(), ends.end(), state.extra_score[side_of(team)].value_or(0),
                         [](int sum, const std::optional<int>& end) { return sum + end.value_or(0); });
}

Judged judge(const GameState& before, const ThrownStones& seen, const GameSetting& setting) {
  const auto team = next_team(before);
  assert(team);
  const Throw thrown{*team, next_stone(before)};
  Judged judged;
  judged.state = before;
  judged.board = seen.lying;
  judged.reason = impossible(before, thrown, seen.lying);
  if (!judged.reason.empty()) return judged;
  judged.ok = true;

  judged.removed = clear(judged.board, thrown, seen.struck, setting);
  judged.free_guard_zone_foul = freed_a_guard(before, judged.board, *team, setting);
  if (judged.free_guard_zone_foul) {
    judged.board = before.board;
    judged.removed.clear();
  }

  judged.state.board = judged.board;
  if (++judged.state.shot < stones_an_end) return judged;
  judged.end = score(judged.board);
  write_down(judged.state, *judged.end, setting);
  begin_end(judged.state, setting);
  return judged;
}

GameState thought(const GameState& before, Duration used) {
  const auto team = next_team(before);
  assert(team);
  GameState after = before;
  Duration& left = after.thinking_left[side_of(*team)];
  left -= used;
  if (left > Duration::zero()) return after;
  left = Duration::zero();
  finish(after, opponent_of(*team), GameReason::time_limit);
  return after;
}

GameState conceded(const GameState& before) {
  const auto team = next_team(before);
  assert(team);
  GameState after = before;
  finish(after, opponent_of(*team), GameReason::concede);
  return after;
}

}  // namespace hogline::servo
