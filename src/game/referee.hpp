// A game between two strategists: asks whose turn it is, has the stone thrown, applies the rules, tells both. Nothing
// is thrown that was not decided in time by the one whose turn it is. Steps; time is an argument; no threads.
#pragma once

#include <array>
#include <string>

#include "hw/strategist.hpp"
#include "src/game/stone_thrower.hpp"

namespace hogline::game {

/// Is told everything in its order: for logs and for those who watch.
class GameListener {
 public:
  virtual ~GameListener() = default;
  /// A draw thrown before the game, from which the ice is learnt; `draw` from 0.
  virtual void practised(int, const ThrowReport&) {}
  virtual void begun(const std::array<std::string, servo::team_count>& names) = 0;
  /// Before each throw, and once more when the game is over.
  virtual void stands(const servo::GameUpdate& update) = 0;
  virtual void decided(const Turn& turn) = 0;
  virtual void thrown(const Turn& turn, const ThrowReport& report, const servo::Judged& judged) = 0;
  virtual void stopped(const std::string& reason) = 0;
};

enum class RefereePhase {
  preparing,  ///< for the strategists
  asking,
  throwing,
  over,     ///< state().result says how
  stopped,  ///< for good, before its end: reason()
};

class Referee {
 public:
  /// All must outlive the referee.
  Referee(const servo::GameSetting& setting, const std::array<hw::Strategist*, servo::team_count>& strategists,
          StoneThrower& thrower, GameListener& listener);
  /// From there on. Precondition: a state that the setting allows, not over.
  Referee(const servo::GameSetting& setting, const servo::GameState& state,
          const std::array<hw::Strategist*, servo::team_count>& strategists, StoneThrower& thrower,
          GameListener& listener);

  void step(Stamp now);
  RefereePhase phase() const { return phase_; }
  const std::string& reason() const { return reason_; }
  const servo::GameState& state() const { return update_.state; }

 private:
  void prepare(Stamp now);
  void ask(Stamp now);
  void finish_throw(const ThrowReport& report, Stamp now);
  void tell(Stamp now);
  void stop(const std::string& reason);

  servo::GameSetting setting_;
  std::array<hw::Strategist*, servo::team_count> strategists_;
  StoneThrower& thrower_;
  GameListener& listener_;
  RefereePhase phase_ = RefereePhase::preparing;
  std::string reason_;
  servo::GameUpdate update_;
  Turn turn_;
};

}  // namespace hogline::game
