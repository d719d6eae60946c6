// A game as it stands. Plain data; what changes it is in servo/game/rules.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "servo/game/board.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::servo {

/// What is agreed before a game.
struct GameSetting {
  int ends = 10;                                      ///< without extra ones; 1 or more
  std::optional<double> sheet_width_m = 4.75;         ///< between the sidelines; empty: none to touch
  int protected_throws = 5;                           ///< five-rock rule: how many of an end's throws may free no guard
  Team first_hammer = Team::second;                   ///< who throws last in the first end
  int most_ends = 255;                                ///< extra ones included; level after so many: a draw
  std::array<Duration, team_count> thinking{};        ///< for all ends but extra ones
  std::array<Duration, team_count> extra_thinking{};  ///< anew for each extra end
};

enum class GameReason { score, concede, time_limit, draw };

struct GameResult {
  std::optional<Team> winner;  ///< empty: a draw
  GameReason reason = GameReason::score;
};

struct GameState {
  int end = 0;                 ///< from 0
  int shot = 0;                ///< the one that is thrown next, 0..15
  std::optional<Team> hammer;  ///< who throws the end's last stone; empty once the game is over
  Board board;
  std::array<std::vector<std::optional<int>>, team_count>
      scores;                                                ///< of each end that is no extra one; empty: not played
  std::array<std::optional<int>, team_count> extra_score{};  ///< of the extra end that decided
  std::array<Duration, team_count> thinking_left{};
  std::optional<GameResult> result;  ///< empty: the game goes on
};

}  // namespace hogline::servo
