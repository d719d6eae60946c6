#include "servo/small_strategy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "servo/game/rules.hpp"

namespace hogline::servo {
namespace {

constexpr double touch_m = 2.0 * in_sheet::stone_radius_m;
constexpr std::array<double, 2> hit_speeds_mps{1.3, 2.0};  // at the contact: control weight, firm
constexpr double guard_ahead_m = 2.6;                      // of the stone that is guarded
constexpr double guard_reach_m = 0.35;                     // aside of its line at which a stone still guards
constexpr std::array<Place, 5> draws_to{
    Place{0.0, 0.0}, {0.35, 0.0}, {-0.35, 0.0}, {0.0, -0.7}, {0.0, 0.6}};  // from the tee, the best first
constexpr double opening_guard_y_m = 34.3;                                 // half-way between hog line and house
constexpr std::array<double, 1> middle_m{0.0};                             // of the sheet: where guards lie
constexpr std::array<double, 2> corners_m{1.1, -1.1};                      // ... that leave the middle open
constexpr double sure_enough_m = 1.0;  // a stone less sure might not come to lie before the house
constexpr int safe_lead = 2;           // points; who has them wants few stones about
constexpr std::array<double, 6> ways_out_m{1.9, -1.9, 1.2, -1.2, 0.6, -0.6};

struct Named {
  Team team;
  BoardStone stone;
};

std::vector<Place> places(const Board& board) {
  std::vector<Place> all;
  for (const auto& team : board.stones)
    for (const auto& stone : team)
      if (stone) all.push_back({stone->x_m, stone->y_m});
  return all;
}

std::optional<Named> shot_stone(const Board& board) {
  std::optional<Named> nearest;
  for (const std::size_t side : {0u, 1u}) {
    for (const auto& stone : board.stones[side]) {
      if (!stone || !in_house(*stone)) continue;
      if (!nearest || from_tee_m(*stone) < from_tee_m(nearest->stone)) nearest = Named{team_of(side), *stone};
    }
  }
  return nearest;
}

/// The answer that an aim makes, and how it is told.
SmallAnswer answer(SmallPlan plan, const IntendedOutcome& aim, bool ok, const std::string& reason,
                   const ShotOrder& order, double sigma_m) {
  SmallAnswer made{ok, reason, plan, order, aim, sigma_m, {}};
  const auto told = ok ? hack_shot_for(aim, order.curl) : std::nullopt;
  if (told) made.told = *told;
  if (ok && !told) made.ok = false, made.reason = "FCV1 has no such shot";
  return made;
}

SmallAnswer draw_to(SmallPlan plan, const Place& place, const Board& board, const ThrowerSkill& skill,
                    const IceModel& ice) {
  const ShotAim aim = aim_shot({place, std::nullopt, places(board)}, skill, ice);
  const double sigma = std::sqrt(aim.covariance.xx_m2 + aim.covariance.yy_m2);
  return answer(plan, {Intent::rest, place}, aim.ok, aim.reason, aim.order, sigma);
}

/// Full on: the contact lies where the stone comes from, which is known once it has been aimed.
SmallAnswer take_out(const BoardStone& target, double speed_mps, const Board& board, const ThrowerSkill& skill,
                     const IceModel& ice) {
  std::vector<Place> others = places(board);
  std::erase_if(others, [&](const Place& p) { return p.x_m == target.x_m && p.y_m == target.y_m; });
  HitWish wish{{target.x_m, target.y_m - touch_m}, speed_mps, std::nullopt, others};
  HitAim aim = aim_hit(wish, skill, ice);
  for (int i = 0; i < 2 && aim.ok; ++i) {
    wish.curl = aim.order.curl;
    wish.contact = {target.x_m + touch_m * std::sin(aim.heading_rad), target.y_m - touch_m * std::cos(aim.heading_rad)};
    aim = aim_hit(wish, skill, ice);
  }
  const IntendedOutcome outcome{Intent::touch, wish.contact, aim.speed_mps, aim.heading_rad, 0};
  return answer(SmallPlan::take_out, outcome, aim.ok, aim.reason, aim.order, aim.aside_sigma_m);
}

SmallAnswer throw_away(double x_m, const Board& board, const ThrowerSkill& skill, const IceModel& ice) {
  const Place behind{x_m, in_sheet::back_y_m + in_sheet::stone_radius_m};
  const HitAim aim = aim_hit({behind, 0.5, std::nullopt, places(board)}, skill, ice);
  const IntendedOutcome outcome{Intent::leave, behind, aim.speed_mps, aim.heading_rad, 0};
  return answer(SmallPlan::throw_away, outcome, aim.ok, aim.reason, aim.order, aim.aside_sigma_m);
}

/// Of the other team, in the house, the nearest to the tee first.
std::vector<BoardStone> targets(const Board& board, Team team) {
  std::vector<BoardStone> stones;
  for (const auto& stone : board.stones[side_of(opponent_of(team))])
    if (stone && in_house(*stone)) stones.push_back(*stone);
  std::ranges::sort(stones, {}, from_tee_m);
  return stones;
}

int lead_of(Team team, const GameState& state) { return total(state, team) - total(state, opponent_of(team)); }

/// The end's first two throws: five throws long nobody may take out what lies before the house. Without the hammer
/// the middle is guarded, with it kept open; not by who would rather have the house empty, nor on ice not yet known.
std::optional<SmallAnswer> opening(const GameState& state, const ThrowerSkill& skill, const IceModel& ice) {
  const Team team = *next_team(state);
  const bool hammer = state.hammer == team;
  if (state.shot > 1 || shot_stone(state.board) || lead_of(team, state) >= (hammer ? 1 : safe_lead))
    return std::nullopt;
  const auto aside = hammer ? std::span<const double>(corners_m) : std::span<const double>(middle_m);
  for (const double x : aside) {
    const SmallAnswer guard = draw_to(SmallPlan::guard, {x, opening_guard_y_m}, state.board, skill, ice);
    if (guard.ok && guard.sigma_m < sure_enough_m) return guard;
  }
  return std::nullopt;
}

/// The end's last throw to an empty house: a single point would give the hammer away, and there are ends to come.
/// Who leads in the last one has won without.
bool better_blank(const GameState& state) {
  const bool last_end = state.end + 1 >= static_cast<int>(state.scores[0].size());
  if (state.shot != stones_an_end - 1 || shot_stone(state.board)) return false;
  return !last_end || lead_of(*next_team(state), state) > 0;
}

bool guarded(const BoardStone& stone, const Board& board) {
  const auto guards = [&](const std::optional<BoardStone>& other) {
    return other && other->y_m < stone.y_m - 1.0 && std::abs(other->x_m - stone.x_m) < guard_reach_m;
  };
  return std::ranges::any_of(board.stones, [&](const auto& team) { return std::ranges::any_of(team, guards); });
}

}  // namespace

std::string_view name_of(SmallPlan plan) {
  constexpr std::array<std::string_view, 4> names{"take out", "guard", "draw", "throw away"};
  return names[static_cast<std::size_t>(plan)];
}

SmallAnswer small_strategy(const GameState& state, const ThrowerSkill& skill, const IceModel& ice) {
  const Team team = *next_team(state);
  const Board& board = state.board;
  const auto shot = shot_stone(board);
  SmallAnswer tried;
  if (auto guard = opening(state, skill, ice)) return *guard;
  const auto take_out_one_of = [&](const std::vector<BoardStone>& stones) {
    for (const BoardStone& stone : stones)
      for (const double speed : hit_speeds_mps)
        if (tried = take_out(stone, speed, board, skill, ice); tried.ok) return true;
    return false;
  };

  if (shot && shot->team != team && take_out_one_of({shot->stone})) return tried;

  const bool last = state.shot == stones_an_end - 1;
  if (shot && shot->team == team && !last && !guarded(shot->stone, board)) {
    const Place place{shot->stone.x_m, std::max(shot->stone.y_m - guard_ahead_m, in_sheet::hog_y_m + 1.0)};
    if (tried = draw_to(SmallPlan::guard, place, board, skill, ice); tried.ok) return tried;
  }

  const auto thrown_away = [&] {
    for (const double x : ways_out_m)
      if (tried = throw_away(x, board, skill, ice); tried.ok) return true;
    return false;
  };
  if (better_blank(state) && thrown_away()) return tried;

  for (const Place& offset : draws_to) {
    const Place place{offset.x_m, in_sheet::tee_y_m + offset.y_m};
    if (tried = draw_to(SmallPlan::draw, place, board, skill, ice); tried.ok) return tried;
  }

  if (take_out_one_of(targets(board, team))) return tried;
  thrown_away();
  return tried;
}

}  // namespace hogline::servo
