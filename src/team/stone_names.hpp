// Which stone is which: what the skip sees of the house against the board of the rules, before and after a throw.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "servo/game/rules.hpp"
#include "servo/place.hpp"
#include "servo/throw_result.hpp"

namespace hogline {

/// A stone by its team's side and its number in it.
struct StoneName {
  std::size_t side = 0;
  std::size_t stone = 0;
  bool operator==(const StoneName&) const = default;
};

/// A place of the skip's e on the board, which is in s.
servo::BoardStone on_board(double x_m, double y_m, double handle_rad);
/// A place of the board in the skip's e.
servo::Place in_skip_frame(const servo::BoardStone& stone);

/// Of each sighting (in the skip's e), the stone of the board that it is; empty: none within 0.3 m that could be.
std::vector<std::optional<StoneName>> names_of(const std::vector<StoneSighting>& seen, const servo::Board& board);

/// What the skip knows of a throw when all lies still.
struct SeenThrow {
  servo::Board before;
  StoneName thrown;
  std::vector<std::optional<StoneName>> names;        ///< of the result's stones by their identities
  std::optional<servo::ThrowResult> followed;         ///< empty: nobody followed it
  std::optional<std::vector<StoneSighting>> counted;  ///< the look at the house afterwards; empty: none
};

struct StonesAfter {
  servo::ThrownStones stones;
  std::vector<std::string> remarks;  ///< where following and counting do not agree, and what was believed
};

/// The look afterwards says where stones lie; following says which stone it is that lies there, and whether it may: one
/// that certainly touched a sideline on its way is out wherever it lies.
StonesAfter stones_after(const SeenThrow& seen);

/// One sigma of the worst seen stone in the house, in any direction (sightings in the skip's e); 0: none is there.
double house_sigma_m(const std::vector<StoneSighting>& counted);

}  // namespace hogline
