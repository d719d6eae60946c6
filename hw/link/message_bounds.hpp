// What a message may say at all, whoever sends it: both ends hold to it.
#pragma once

#include "hw/team_messages.hpp"

namespace hogline::hw::link {

/// All numbers finite, no text or list longer than wire_values.hpp allows, no text with a zero byte, teams and fates
/// among the known words, times not negative. Says nothing of whether a robot could do it.
bool within_bounds(const TeamMessage& message);

}  // namespace hogline::hw::link
