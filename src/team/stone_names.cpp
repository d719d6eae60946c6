#include "src/team/stone_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "servo/skip_sheet.hpp"

namespace hogline {
namespace {

using servo::StoneFate;

constexpr double same_board_m = 0.3;     // nobody touches stones between two throws but to tidy up
constexpr double same_count_m = 0.25;    // a resting place as followed and as counted: stones are 0.29 m apart
constexpr double moved_sigmas = 4.0;     // of two looks at a stone that has not moved
constexpr double sight_slope = 0.4;      // aside to along, of any sight from behind the house to its guards
constexpr double counted_up_to_m = 6.5;  // from the tee: the house and its guards are in the near view

bool may_be(Team seen, std::size_t side) { return seen == Team::unknown || servo::side_of(seen) == side; }

struct Pair {
  std::size_t seen;
  std::size_t known;
  double apart_m;
};

/// Pairs of the nearest, each used once.
std::vector<Pair> nearest_pairs(std::vector<Pair> pairs) {
  std::ranges::sort(pairs, {}, &Pair::apart_m);
  std::vector<Pair> chosen;
  for (const Pair& p : pairs) {
    const auto used = [&](const Pair& c) { return c.seen == p.seen || c.known == p.known; };
    if (std::ranges::none_of(chosen, used)) chosen.push_back(p);
  }
  return chosen;
}

/// A stone as far as following it tells.
struct Known {
  StoneName name;
  double x_m = 0.0;  // e of the skip
  double y_m = 0.0;
  double handle_rad = 0.0;
  bool lies = true;             // on the sheet
  bool certain = true;          // ... or not
  bool seen = false;            // in the count
  double across_sigma_m = 0.0;  // of that place, along x
};

Known as_before(const StoneName& name, const servo::BoardStone& stone) {
  const servo::Place at = in_skip_frame(stone);
  return {.name = name, .x_m = at.x_m, .y_m = at.y_m, .handle_rad = stone.angle_rad - std::numbers::pi};
}

std::vector<Known> known_of(const SeenThrow& seen) {
  std::vector<Known> all;
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < servo::stones_each; ++i) {
      if (const auto& stone = seen.before.stones[side][i]) all.push_back(as_before({side, i}, *stone));
    }
  }
  all.push_back({.name = seen.thrown, .lies = false, .certain = false});
  if (!seen.followed) {
    for (Known& k : all) k.certain = false;
    return all;
  }
  for (const servo::StoneOutcome& s : seen.followed->stones) {
    const auto id = static_cast<std::size_t>(s.id);
    if (!s.thrown && (id >= seen.names.size() || !seen.names[id])) continue;
    const StoneName name = s.thrown ? seen.thrown : *seen.names[id];
    const auto known = std::ranges::find(all, name, &Known::name);
    if (known == all.end()) continue;
    known->x_m = s.x_m, known->y_m = s.y_m;
    known->lies = s.fate == StoneFate::at_rest || s.fate == StoneFate::hogged;
    known->certain = s.certain && s.fate != StoneFate::lost;
  }
  return all;
}

std::string words(const Known& k) { return fmt::format("stone {} of team{}", k.name.stone + 1, k.name.side); }

void take(Known& known, const StoneSighting& seen) {
  known.x_m = seen.x_m, known.y_m = seen.y_m;
  known.handle_rad = seen.handle_rad.value_or(known.handle_rad);
  known.seen = true;
  known.across_sigma_m = std::sqrt(seen.covariance.xx_m2);
}

void count(std::vector<Known>& known, const std::vector<StoneSighting>& counted, std::vector<std::string>& remarks) {
  std::vector<Pair> near, left;
  std::vector<bool> used(counted.size());
  for (std::size_t i = 0; i < counted.size(); ++i) {
    for (std::size_t k = 0; k < known.size(); ++k) {
      const double apart = std::hypot(counted[i].x_m - known[k].x_m, counted[i].y_m - known[k].y_m);
      if (apart < same_count_m && may_be(counted[i].team, known[k].name.side)) near.push_back({i, k, apart});
    }
  }
  for (const Pair& p : nearest_pairs(near)) {
    used[p.seen] = known[p.known].seen = true;
    if (!known[p.known].lies && known[p.known].certain) continue;  // out, and lies there
    take(known[p.known], counted[p.seen]);
    known[p.known].lies = true;
  }
  for (std::size_t i = 0; i < counted.size(); ++i) {
    for (std::size_t k = 0; k < known.size() && !used[i]; ++k) {
      const bool open = !known[k].seen && (known[k].lies || !known[k].certain);
      if (!open || !may_be(counted[i].team, known[k].name.side)) continue;
      left.push_back({i, k, std::hypot(counted[i].x_m - known[k].x_m, counted[i].y_m - known[k].y_m)});
    }
  }
  for (const Pair& p : nearest_pairs(left)) {
    used[p.seen] = true;
    remarks.push_back(
        fmt::format("{} is counted {:.2f} m from where it was followed to", words(known[p.known]), p.apart_m));
    take(known[p.known], counted[p.seen]);
    known[p.known].lies = true;
  }
  for (std::size_t i = 0; i < counted.size(); ++i) {
    if (used[i]) continue;
    remarks.push_back(fmt::format("something is seen at ({:.2f}, {:.2f}) that can be none of the stones",
                                  counted[i].x_m, counted[i].y_m));
  }
  for (Known& k : known) {
    if (k.seen || !k.lies || k.y_m > counted_up_to_m) continue;
    remarks.push_back(words(k) + " is not seen in the count; it is believed to lie where it was last");
  }
}

// Only the thrown stone moves others. A touch too slight to be seen as one is told by where a stone is counted: aside,
// for along the sight all stones of a look are shifted alike by as little as the head's tilt is off.
bool was_moved(const Known& k, const SeenThrow& seen) {
  if (!k.seen || !k.lies || k.name == seen.thrown) return false;
  const servo::Place before = in_skip_frame(*seen.before.stones[k.name.side][k.name.stone]);
  const double aside_m = std::abs(k.x_m - before.x_m) - sight_slope * std::abs(k.y_m - before.y_m);
  return aside_m > moved_sigmas * std::numbers::sqrt2 * k.across_sigma_m;
}

}  // namespace

servo::BoardStone on_board(double x_m, double y_m, double handle_rad) {
  return {-x_m, servo::far_tee_in_sheet_m - y_m, std::remainder(handle_rad + std::numbers::pi, 2.0 * std::numbers::pi)};
}

servo::Place in_skip_frame(const servo::BoardStone& stone) {
  return {-stone.x_m, servo::far_tee_in_sheet_m - stone.y_m};
}

std::vector<std::optional<StoneName>> names_of(const std::vector<StoneSighting>& seen, const servo::Board& board) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t k = 0; k < servo::stones_an_end; ++k) {
      const auto& stone = board.stones[k / servo::stones_each][k % servo::stones_each];
      if (!stone || !may_be(seen[i].team, k / servo::stones_each)) continue;
      const servo::Place at = in_skip_frame(*stone);
      const double apart = std::hypot(seen[i].x_m - at.x_m, seen[i].y_m - at.y_m);
      if (apart < same_board_m) pairs.push_back({i, k, apart});
    }
  }
  std::vector<std::optional<StoneName>> names(seen.size());
  for (const Pair& p : nearest_pairs(pairs)) {
    names[p.seen] = StoneName{p.known / servo::stones_each, p.known % servo::stones_each};
  }
  return names;
}

StonesAfter stones_after(const SeenThrow& seen) {
  StonesAfter after;
  std::vector<Known> known = known_of(seen);
  if (seen.counted) count(known, *seen.counted, after.remarks);
  for (const Known& k : known) {
    if (k.lies) after.stones.lying.stones[k.name.side][k.name.stone] = on_board(k.x_m, k.y_m, k.handle_rad);
  }
  after.stones.struck = std::ranges::any_of(known, [&](const Known& k) { return was_moved(k, seen); });
  if (!seen.followed || after.stones.struck) return after;
  const auto& stones = seen.followed->stones;
  const auto thrown = std::ranges::find(stones, true, &servo::StoneOutcome::thrown);
  after.stones.struck =
      thrown != stones.end() && std::ranges::any_of(seen.followed->collisions, [&](const servo::WorldCollision& c) {
        return c.striker == thrown->id || c.struck == thrown->id;
      });
  return after;
}

double house_sigma_m(const std::vector<StoneSighting>& counted) {
  double sigma_m = 0.0;
  for (const StoneSighting& s : counted) {
    if (std::hypot(s.x_m, s.y_m) > servo::in_sheet::house_radius_m + servo::in_sheet::stone_radius_m) continue;
    sigma_m = std::max(sigma_m, std::sqrt(std::max(s.covariance.xx_m2, s.covariance.yy_m2)));
  }
  return sigma_m;
}

}  // namespace hogline
