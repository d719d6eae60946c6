// The stones of one end and what the rules call their places (World Curling, Rules of Curling, R1, R5 and R6). Frame s:
// the delivering end's hack line at y = 0, the house that is played to around (0, 38.405).
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "vision/percepts/stones.hpp"

namespace hogline::servo {

inline constexpr int team_count = 2;
inline constexpr int stones_each = 8;
inline constexpr int stones_an_end = team_count * stones_each;

namespace in_sheet {
inline constexpr double tee_y_m = 38.405;
inline constexpr double hog_y_m = 32.004;   ///< the house-side edge of the line that must be passed
inline constexpr double back_y_m = 40.234;  ///< the line's outer edge
inline constexpr double house_radius_m = 1.829;
inline constexpr double stone_radius_m = 0.145;
}  // namespace in_sheet

/// A stone that lies on the ice. `angle_rad` is its handle's, counter-clockwise, for those who draw it.
struct BoardStone {
  double x_m = 0.0;
  double y_m = 0.0;
  double angle_rad = 0.0;
  bool operator==(const BoardStone&) const = default;
};

/// Every stone by its team and by which of the team's stones it is, in the order of their throws; empty: not thrown
/// yet, or out of play.
struct Board {
  std::array<std::array<std::optional<BoardStone>, stones_each>, team_count> stones{};
  bool operator==(const Board&) const = default;
};

/// Which of a Board's two. Precondition: `first` or `second`.
constexpr std::size_t side_of(Team team) { return team == Team::first ? 0 : 1; }
constexpr Team team_of(std::size_t side) { return side == 0 ? Team::first : Team::second; }
constexpr Team opponent_of(Team team) { return team == Team::first ? Team::second : Team::first; }

double from_tee_m(const BoardStone& stone);

/// In the house, or biting it.
bool in_house(const BoardStone& stone);
/// In front of the tee line and touching neither it nor the house. A stone short of the hog line that is in play (it
/// hit another) counts too.
bool in_free_guard_zone(const BoardStone& stone);
/// Wholly past the hog line.
bool past_hog_line(const BoardStone& stone);
/// Wholly past the back line.
bool past_back_line(const BoardStone& stone);
bool touches_sideline(const BoardStone& stone, double sheet_width_m);

/// What an end yields: at most one of the two is above 0.
using EndScore = std::array<int, team_count>;

/// A team scores each stone in the house that is nearer to the tee than every one of the other team's. Two nearest
/// stones of the two teams that are equally near: nobody scores.
EndScore score(const Board& board);
/// By how much stones would have to lie nearer to the tee, or farther, for the score to be another one; large where no
/// stone is near a border.
double score_margin_m(const Board& board);

}  // namespace hogline::servo
