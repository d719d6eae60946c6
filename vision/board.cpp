#include "vision/board.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::vision {
namespace {

constexpr double sigmas = 2.0;
constexpr double no_sideline_m = 10.0;

// One standard deviation of the distance from a point at (-dx, -dy) of the stone.
double sigma_along(const StoneSighting& s, double dx, double dy) {
  const double length = std::hypot(dx, dy);
  if (length < 1e-9) return std::sqrt(std::max(s.covariance.xx_m2, s.covariance.yy_m2));
  const double x = dx / length;
  const double y = dy / length;
  return std::sqrt(
      std::max(0.0, x * x * s.covariance.xx_m2 + 2.0 * x * y * s.covariance.xy_m2 + y * y * s.covariance.yy_m2));
}

void note_touches(RuledStone& s, std::optional<double> width_m, double radius_m) {
  const double x = s.seen.x_m;
  const double y = s.seen.y_m;
  if (std::abs(x) <= radius_m + 0.5 * rules::thin_line_width_m) s.touches.emplace_back("centre_line");
  for (const char* name : {"back_line", "tee_line", "hog_line"}) {
    const CrossLine& line = cross_line(name);
    if (y + radius_m >= line.near_edge_y_m && y - radius_m <= line.far_edge_y_m) s.touches.emplace_back(name);
  }
  if (width_m && -x + radius_m >= 0.5 * *width_m) s.touches.emplace_back("left_sideline");
  if (width_m && x + radius_m >= 0.5 * *width_m) s.touches.emplace_back("right_sideline");
}

RuledStone ruled(const StoneSighting& seen, std::optional<double> width_m, double radius_m) {
  RuledStone s;
  s.seen = seen;
  s.tee_distance_m = std::hypot(seen.x_m, seen.y_m);
  s.side_margin_m = width_m ? 0.5 * *width_m - radius_m - std::abs(seen.x_m) : no_sideline_m;
  s.back_margin_m = seen.y_m + radius_m + rules::tee_to_back_m;
  s.hog_margin_m = rules::tee_to_hog_m - seen.y_m - radius_m;
  s.house_margin_m = rules::outer_ring_radius_m + radius_m - s.tee_distance_m;
  s.hogged = s.hog_margin_m <= 0.0;
  s.in_play = s.side_margin_m > 0.0 && s.back_margin_m > 0.0 && !s.hogged;
  s.in_house = s.in_play && s.house_margin_m > 0.0;
  const double across = sigmas * std::sqrt(seen.covariance.xx_m2);
  const double along = sigmas * std::sqrt(seen.covariance.yy_m2);
  const double radial = sigmas * sigma_along(seen, seen.x_m, seen.y_m);
  s.certain = std::abs(s.side_margin_m) > across && std::abs(s.back_margin_m) > along &&
              std::abs(s.hog_margin_m) > along && std::abs(s.house_margin_m) > radial;
  note_touches(s, width_m, radius_m);
  return s;
}

bool shot_is_certain(const Board& board) {
  const RuledStone& best = board.stones.front();
  if (best.seen.team == Team::unknown || !best.certain) return false;
  for (const RuledStone& s : board.stones) {
    if (!s.in_house || s.seen.team == best.seen.team) continue;
    const double doubt =
        std::hypot(sigma_along(best.seen, best.seen.x_m, best.seen.y_m), sigma_along(s.seen, s.seen.x_m, s.seen.y_m));
    return s.tee_distance_m - best.tee_distance_m > sigmas * doubt;
  }
  return true;
}

}  // namespace

Board judge(const std::vector<StoneSighting>& stones, std::optional<double> sheet_width_m, double stone_radius_m) {
  Board board;
  for (const StoneSighting& s : stones) board.stones.push_back(ruled(s, sheet_width_m, stone_radius_m));
  std::stable_sort(board.stones.begin(), board.stones.end(), [](const RuledStone& a, const RuledStone& b) {
    return a.in_house != b.in_house ? a.in_house : a.tee_distance_m < b.tee_distance_m;
  });
  int order = 0;
  for (RuledStone& s : board.stones) {
    if (s.in_house) s.order = ++order;
  }
  if (order == 0) return board;
  board.shot = 0;
  board.scoring = board.stones.front().seen.team;
  board.shot_certain = shot_is_certain(board);
  if (board.scoring == Team::unknown) return board;
  for (const RuledStone& s : board.stones) {
    if (!s.in_house || s.seen.team != board.scoring) break;
    ++board.score;
  }
  return board;
}

}  // namespace hogline::vision
