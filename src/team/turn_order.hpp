// What is ordered in a turn: the strategist's shot, among the stones as the skip has just seen them.
#pragma once

#include "src/game/stone_thrower.hpp"
#include "src/team/stone_names.hpp"

namespace hogline {

struct TurnOrder {
  std::vector<std::optional<StoneName>> names;  ///< of the sightings, as names_of() has it
  servo::ShotOrder order;                       ///< unless refused
  std::optional<servo::MappedShot> mapped;      ///< where it was a shot of Digital Curling
  std::string refused;                          ///< why it can not be thrown; empty: it can
  std::vector<std::string> remarks;
};

/// The stones are where the skip has just seen them; those that it did not see are where they were. Takes up to some
/// tenths of a second.
TurnOrder order_of(const game::Turn& turn, const std::vector<StoneSighting>& standing,
                   std::optional<double> sheet_width_m, const servo::ThrowerSkill& skill, const servo::IceModel& ice);

}  // namespace hogline
