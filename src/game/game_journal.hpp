// A game as JSON lines, one event a line, and beside it as Digital Curling's game.dcl2.
#pragma once

#include <functional>
#include <string>

#include "hw/digital_curling/game_log.hpp"
#include "src/game/referee.hpp"

namespace hogline::game {

class GameJournal final : public GameListener {
 public:
  /// `line` is given each event, a JSON object without its line's end; `player_orders` is asked when the game begins.
  /// The log must outlive the journal.
  using PlayerOrders = std::array<std::array<int, 4>, servo::team_count>;
  GameJournal(std::function<void(const std::string&)> line, hw::digital_curling::GameLog& log,
              const hw::digital_curling::GameIdentity& identity, const hw::digital_curling::GameOffer& offer,
              std::function<PlayerOrders()> player_orders);

  void practised(int draw, const ThrowReport& report) override;
  void begun(const std::array<std::string, servo::team_count>& names) override;
  void stands(const servo::GameUpdate& update) override;
  void decided(const Turn& turn) override;
  void thrown(const Turn& turn, const ThrowReport& report, const servo::Judged& judged) override;
  void stopped(const std::string& reason) override;

 private:
  std::function<void(const std::string&)> line_;
  hw::digital_curling::GameLog& log_;
  hw::digital_curling::GameIdentity identity_;
  hw::digital_curling::GameOffer offer_;
  std::function<PlayerOrders()> player_orders_;
  int end_ = 0;
  int shot_ = 0;
};

}  // namespace hogline::game
