// The record of a game as Digital Curling programs replay it: game.dcl2, one line of JSON an entry. The order of
// entries: begin() with what was agreed, then an update, then a move and the update after it, ..., then game over.
#pragma once

#include <functional>
#include <ostream>
#include <string>

#include "hw/digital_curling/messages.hpp"

namespace hogline::hw::digital_curling {

class GameLog {
 public:
  /// `date_time` gives the moment of each entry in ISO 8601. The stream must outlive the log.
  GameLog(std::ostream& to, std::function<std::string()> date_time);

  void begin(const GameIdentity& identity, const GameOffer& offer,
             const std::array<std::string, servo::team_count>& names,
             const std::array<std::array<int, 4>, servo::team_count>& player_orders);
  /// The stones' trajectories are left out, as the format has it.
  void update(const servo::GameUpdate& update);
  void move(Team team, const servo::GameMove& move);
  void game_over();
  void error(const std::string& what);

 private:
  void entry(const char* tag, const std::string& json);

  std::ostream& to_;
  std::function<std::string()> date_time_;
  int next_id_ = 0;
};

}  // namespace hogline::hw::digital_curling
