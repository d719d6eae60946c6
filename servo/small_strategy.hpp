// A small strategist that knows the ice it plays on: it opens an end with a guard, takes the other team's shot
// stone out, guards its own, draws to the tee, and keeps the hammer where the house is empty. Pure; no look-ahead.
// Frame s.
#pragma once

#include <string>
#include <string_view>

#include "servo/game/game_state.hpp"
#include "servo/shot_mapping.hpp"

namespace hogline::servo {

enum class SmallPlan {
  take_out,    ///< an opponent's stone in the house
  guard,       ///< of its own shot stone, or before the house at the end's beginning
  draw,        ///< to the tee or beside it
  throw_away,  ///< through, past all stones: where nothing better has a free way, or a blank end is better than a point
};

struct SmallAnswer {
  bool ok = false;
  std::string reason;  ///< why not, when !ok: what the last plan failed at
  SmallPlan plan = SmallPlan::draw;
  ShotOrder order;       ///< for this thrower on this ice
  IntendedOutcome aim;   ///< what it shall come to
  double sigma_m = 0.0;  ///< of the place: of a rest in any direction, else across the way
  HackShot told;         ///< the same for those who think in Digital Curling's shots
};

/// Preconditions: the game is not over.
SmallAnswer small_strategy(const GameState& state, const ThrowerSkill& skill, const IceModel& ice);

std::string_view name_of(SmallPlan plan);

}  // namespace hogline::servo
