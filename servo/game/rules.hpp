// The rules of a game of curling (World Curling, Rules of Curling: R5 delivery and stones in play, R6 free guard zone,
// R11 scoring; five-rock rule): what a state becomes by a throw, by thinking, by conceding. Pure functions of states.
//
// Where Digital Curling differs: it takes away every stone that rests short of the hog line, also one that hit another.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "servo/game/game_state.hpp"

namespace hogline::servo {

/// Precondition: ends >= 1.
GameState new_game(const GameSetting& setting);

/// Who throws next; nothing once the game is over.
std::optional<Team> next_team(const GameState& state);
/// Which of its team's stones is thrown next.
inline std::size_t next_stone(const GameState& state) { return static_cast<std::size_t>(state.shot / team_count); }
int total(const GameState& state, Team team);

/// What was seen of a throw once all stones lie still.
struct ThrownStones {
  Board lying;          ///< every stone that lies anywhere; empty: it left the sheet, as far as was seen
  bool struck = false;  ///< the thrown stone hit one in play
};

enum class OutOfPlay { sideline, through, hogged };

struct Removal {
  Team team = Team::unknown;
  std::size_t stone = 0;
  OutOfPlay why = OutOfPlay::sideline;
};

struct Judged {
  bool ok = false;
  std::string reason;  ///< why not, when !ok: what was seen can not be; `state` is the one before
  GameState state;     ///< after the throw
  Board board;         ///< as it lies after the throw, also when the end is over and `state` has no stones
  bool free_guard_zone_foul = false;  ///< a guard was freed too early: all stones back, the thrown one away
  std::vector<Removal> removed;       ///< stones that lay where they may not; none of a foul
  std::optional<EndScore> end;        ///< of the end, when it was its last throw
};

/// Precondition: the game is not over.
Judged judge(const GameState& before, const ThrownStones& seen, const GameSetting& setting);

/// The team whose turn it is has thought for so long. One that has used up all its time has lost.
GameState thought(const GameState& before, Duration used);
/// It gives the game up.
GameState conceded(const GameState& before);

}  // namespace hogline::servo
