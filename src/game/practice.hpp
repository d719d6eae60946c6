// Before the first end: draws to the tee on the empty sheet, by turns with either curl, from which the ice is learnt.
// Nothing of it counts. Who decides may prepare meanwhile. Steps; time is an argument; no threads.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "servo/ice_model.hpp"
#include "src/game/stone_thrower.hpp"

namespace hogline::game {

class Practice {
 public:
  /// Is told each draw when it has ended; `draw` from 0.
  using Told = std::function<void(int draw, const Turn& turn, const ThrowReport& report)>;

  /// All must outlive it. `ice`: as it is known at the moment of the question.
  Practice(int draws, const servo::ThrowerSkill& skill, std::function<servo::IceModel()> ice,
           const std::array<hw::Strategist*, servo::team_count>& strategists, StoneThrower& thrower, Told told);

  void step(Stamp now);
  /// All have been thrown, or one has failed.
  bool over() const { return !failure_.empty() || (thrown_ >= draws_ && !throwing_); }
  /// Why one could not be thrown; empty: none has failed.
  const std::string& failure() const { return failure_; }

 private:
  void begin_draw(Stamp now);

  int draws_;
  servo::ThrowerSkill skill_;
  std::function<servo::IceModel()> ice_;
  std::array<hw::Strategist*, servo::team_count> strategists_;
  StoneThrower& thrower_;
  Told told_;
  Turn turn_;
  int thrown_ = 0;
  bool throwing_ = false;
  std::string failure_;
};

}  // namespace hogline::game
