// The table of a game: the strategists who sit at it, what is agreed with them, and the record that is kept.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <string>

#include "hw/digital_curling/digital_curling_strategist.hpp"
#include "src/game/game_journal.hpp"
#include "src/game/referee.hpp"

namespace hogline {

struct TableOptions {
  int ends = 2;
  int practice = 2;                 ///< draws before the first end
  std::string first = "built-in";   ///< built-in, or dc:PORT for a Digital Curling client
  std::string second = "built-in";  ///< who has the hammer in the first end
  std::string address = "127.0.0.1";
  double thinking_s = 2280.0;       ///< each team's for the whole game
  double extra_thinking_s = 270.0;  ///< each team's for each extra end
  double connect_s = 300.0;         ///< how long clients are waited for
  std::string out = "out/game";     ///< a folder that is there; empty: nothing is written down
  bool print = true;                ///< each event also on stdout
};

/// Empty when `text` names a strategist, else what is allowed: a check for the command line.
std::string known_strategist(const std::string& text);

/// Throws ConfigError where both teams' clients are to come to one port.
void check_seats(const TableOptions& options);

class GameTable {
 public:
  /// `ice`: as it is known at the moment of the question. Throws std::runtime_error where the folder can not be
  /// written.
  GameTable(const TableOptions& options, double sheet_width_m, const servo::ThrowerSkill& skill,
            std::function<servo::IceModel()> ice);
  GameTable(const GameTable&) = delete;
  GameTable& operator=(const GameTable&) = delete;

  const servo::GameSetting& setting() const { return offer_.setting; }
  std::array<hw::Strategist*, servo::team_count> strategists();
  /// Writes OUT/game.jsonl and OUT/game.dcl2, and each event on stdout where that is wanted.
  game::GameListener& journal() { return journal_; }

  /// The draws before the game. Empty, or why one could not be thrown, which is written down too.
  std::string practise(const TableOptions& options, const servo::ThrowerSkill& skill,
                       const std::function<servo::IceModel()>& ice, game::StoneThrower& thrower);
  /// Steps the referee until it stops, the game is over, or `enough` says so. Clients are given time to answer.
  void play(game::Referee& referee, const std::function<bool()>& enough = {});
  /// Throws std::runtime_error where the record could not be written.
  void close();

 private:
  void seat(std::size_t side, const TableOptions& options, const servo::ThrowerSkill& skill,
            const std::function<servo::IceModel()>& ice);
  game::GameJournal::PlayerOrders player_orders() const;

  std::string out_;
  hw::digital_curling::GameIdentity identity_;
  hw::digital_curling::GameOffer offer_;
  std::array<std::unique_ptr<hw::Strategist>, servo::team_count> strategists_;
  std::array<const hw::DigitalCurlingStrategist*, servo::team_count> clients_{};
  std::ofstream lines_;
  std::ofstream record_;
  hw::digital_curling::GameLog log_;
  game::GameJournal journal_;
};

}  // namespace hogline
