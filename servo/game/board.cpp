#include "servo/game/board.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::servo {
namespace {

using in_sheet::stone_radius_m;

constexpr double biting_m = in_sheet::house_radius_m + stone_radius_m;

double nearest_m(const Board& board, std::size_t side) {
  double nearest = biting_m;
  for (const auto& stone : board.stones[side]) {
    if (stone) nearest = std::min(nearest, from_tee_m(*stone));
  }
  return nearest;
}

}  // namespace

double from_tee_m(const BoardStone& stone) { return std::hypot(stone.x_m, stone.y_m - in_sheet::tee_y_m); }

bool in_house(const BoardStone& stone) { return from_tee_m(stone) < biting_m; }

bool in_free_guard_zone(const BoardStone& stone) {
  return !in_house(stone) && stone.y_m + stone_radius_m < in_sheet::tee_y_m;
}

bool past_hog_line(const BoardStone& stone) { return stone.y_m - stone_radius_m > in_sheet::hog_y_m; }

bool past_back_line(const BoardStone& stone) { return stone.y_m - stone_radius_m >= in_sheet::back_y_m; }

bool touches_sideline(const BoardStone& stone, double sheet_width_m) {
  return std::abs(stone.x_m) + stone_radius_m >= 0.5 * sheet_width_m;
}

EndScore score(const Board& board) {
  EndScore points{};
  for (const std::size_t side : {0u, 1u}) {
    const double others_m = nearest_m(board, 1 - side);
    points[side] = static_cast<int>(std::ranges::count_if(
        board.stones[side], [&](const auto& stone) { return stone && from_tee_m(*stone) < others_m; }));
  }
  return points;
}

double score_margin_m(const Board& board) {
  constexpr double reach_m = in_sheet::house_radius_m + in_sheet::stone_radius_m;
  std::array<double, team_count> nearest{1e9, 1e9};
  for (const std::size_t side : {0u, 1u})
    for (const auto& stone : board.stones[side])
      if (stone) nearest[side] = std::min(nearest[side], from_tee_m(*stone));
  const std::size_t winner = nearest[0] <= nearest[1] ? 0 : 1;
  // The winner's stones count up to the house's edge or to the other team's first.
  const double limit_m = std::min(reach_m, nearest[1 - winner]);
  double margin_m = 1e9;
  for (const auto& stone : board.stones[winner])
    if (stone) margin_m = std::min(margin_m, std::abs(from_tee_m(*stone) - limit_m));
  return margin_m;
}

}  // namespace hogline::servo
