// Port: who decides what a team does in its turn.
//
// Lock-step: once every team's strategist is ready, begin(); then tell() before every throw, of either team, and once
// more when the game is over. The one whose turn it is thinks until it has decided, is late, or has failed; nothing is
// thrown unless it has decided. A failure is for good, with its reason.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "servo/game/game_update.hpp"
#include "vision/percepts/stamp.hpp"

namespace hogline::hw {

enum class StrategistPhase {
  preparing,  ///< not there yet
  ready,      ///< waits for begin()
  waiting,    ///< it is not its turn
  thinking,   ///< its time runs
  decided,    ///< its decision is there, until the next tell()
  late,       ///< its time is over, and nothing was decided
  over,       ///< was told that the game is over
  failed,
};

struct StrategistDecision {
  servo::GameMove move;
  std::optional<servo::ShotOrder> order{};  ///< of one that knows our ice: thrown as it is, instead of `move`
  Duration thought{};
  std::string plan{};  ///< in words, where it says what it wants
};

struct StrategistState {
  StrategistPhase phase = StrategistPhase::preparing;
  std::string name;
  std::optional<StrategistDecision> decision;  ///< exactly when decided
  std::string reason;                          ///< exactly when late or failed: what happened
  std::string note;                            ///< what was refused without harm; empty: nothing
};

class Strategist {
 public:
  virtual ~Strategist() = default;
  /// Precondition: ready. The names are the teams', first and second.
  virtual void begin(const std::array<std::string, servo::team_count>& names, Stamp now) = 0;
  /// Precondition: begun, and not thinking.
  virtual void tell(const servo::GameUpdate& update, Stamp now) = 0;
  /// Takes in what has come and lets time pass. Never blocks.
  virtual void step(Stamp now) = 0;
  virtual const StrategistState& state() const = 0;
};

}  // namespace hogline::hw
