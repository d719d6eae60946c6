// Port: who throws the stone of a turn and sees what becomes of it. Two robots do; so does an outcome model.
#pragma once

#include <optional>
#include <string>

#include "hw/strategist.hpp"
#include "servo/game/rules.hpp"
#include "servo/shot_mapping.hpp"

namespace hogline::game {

struct Turn {
  Team team = Team::first;
  std::size_t stone = 0;  ///< which of the team's
  servo::Board board;     ///< as it lies before the throw
  hw::StrategistDecision decision;
};

enum class ThrowEnd {
  thrown,
  refused,  ///< the shot can not be thrown: nothing has moved, and the stone is given away
  failed,   ///< the robots can not go on: the game stops
};

struct ThrowReport {
  ThrowEnd end = ThrowEnd::failed;
  std::string reason;                           ///< why, unless thrown
  servo::ShotOrder order;                       ///< what was ordered, when thrown
  std::optional<servo::MappedShot> mapped;      ///< how the shot became the order, where it was one of Digital Curling
  servo::ThrownStones seen;                     ///< what lies where afterwards, when thrown
  double seen_sigma_m = 0.0;                    ///< one sigma of a place in the house; 0: not said
  std::optional<servo::Trajectory> trajectory;  ///< without its `finish`, which is the rules'
};

class StoneThrower {
 public:
  virtual ~StoneThrower() = default;
  /// Precondition: the one before has ended.
  virtual void start(const Turn& turn, Stamp now) = 0;
  /// The report, once, when the throw has ended.
  virtual std::optional<ThrowReport> step(Stamp now) = 0;
};

}  // namespace hogline::game
