#include "servo/stone_world.hpp"

#include <algorithm>
#include <cmath>

#include "servo/assignment.hpp"
#include "servo/skip_sheet.hpp"
#include "servo/stray_looks.hpp"

namespace hogline::servo {
namespace {

constexpr Duration longest_step = std::chrono::milliseconds(20);
constexpr double apart_m = 0.45;
constexpr double impossible_cost = 1e6;
constexpr double gate_square = 30.0;
constexpr double least_probability = 1e-4;
constexpr int looks_to_rest = 4;
constexpr std::size_t most_ends = 60;
constexpr Duration time_to_rest = std::chrono::milliseconds(300);

struct Pair {
  std::size_t striker = 0;
  std::size_t struck = 0;
  Meeting meeting;
};

bool is_settled(const World& world, int a, int b) {
  const std::pair<int, int> pair = std::minmax(a, b);
  return std::find(world.settled.begin(), world.settled.end(), pair) != world.settled.end();
}

bool less_probable(const Impact& a, const Impact& b) { return a.probability < b.probability; }

/// The first two that may touch within the time.
std::optional<Pair> next_meeting(const World& world, double within_s) {
  std::optional<Pair> first;
  for (std::size_t i = 0; i < world.stones.size(); ++i) {
    for (std::size_t j = 0; j < world.stones.size(); ++j) {
      const WorldStone &a = world.stones[i], &b = world.stones[j];
      const bool faster = speed_mps(a.motion.stone) > speed_mps(b.motion.stone);
      if (i == j || !faster || a.phase != StonePhase::moving || b.phase == StonePhase::gone) continue;
      if (is_settled(world, a.id, b.id)) continue;
      const auto m = meeting(a.motion, b.motion);
      if (!m || m->after_s > within_s || (first && first->meeting.after_s <= m->after_s)) continue;
      first = Pair{i, j, *m};
    }
  }
  return first;
}

void forget_parted(World& world) {
  const auto parted = [&](const std::pair<int, int>& pair) {
    const WorldStone *a = world.find(pair.first), *b = world.find(pair.second);
    const SlidingStone &p = a->motion.stone, &q = b->motion.stone;
    const bool near = std::hypot(p.x_m - q.x_m, p.y_m - q.y_m) < apart_m;
    return !near && !meeting(a->motion, b->motion);
  };
  world.settled.erase(std::remove_if(world.settled.begin(), world.settled.end(), parted), world.settled.end());
}

void advance_all(World& world, Stamp to, const WorldConfig& config) {
  for (WorldStone& stone : world.stones) advance(stone.motion, to, config.noise);
  world.stamp = to;
  forget_parted(world);
}

World touched(const World& world, const Pair& pair, const Impact& impact) {
  World after = world;
  WorldStone &striker = after.stones[pair.striker], &struck = after.stones[pair.struck];
  const SlidingStone at = struck.motion.stone, from = striker.motion.stone;
  const double gap = std::max(1e-3, std::hypot(at.x_m - from.x_m, at.y_m - from.y_m));
  const double half = stone_radius_m / gap;
  after.collisions.push_back({world.stamp, striker.id, struck.id, at.x_m + half * (from.x_m - at.x_m),
                              at.y_m + half * (from.y_m - at.y_m), at.x_m, at.y_m});
  striker.motion = impact.striker;
  struck.motion = impact.struck;
  struck.phase = StonePhase::moving;
  struck.has_moved = true;
  struck.resting_since.reset();
  striker.looks_at_rest = struck.looks_at_rest = 0;
  return after;
}

void run(World world, Stamp to, const WorldConfig& config, std::vector<World>& ends) {
  while (world.stamp < to) {
    const Stamp next = std::min(to, world.stamp + longest_step);
    const auto pair = next_meeting(world, seconds(next - world.stamp));
    if (!pair) {
      advance_all(world, next, config);
      continue;
    }
    advance_all(world, world.stamp + from_seconds(pair->meeting.after_s), config);
    const StoneMotion striker = world.stones[pair->striker].motion, struck = world.stones[pair->struck].motion;
    world.settled.push_back(std::minmax(world.stones[pair->striker].id, world.stones[pair->struck].id));
    world.looks_since_split = 0;
    // A rack of stones may part in more ways than anybody can follow: then only the likeliest of each.
    std::vector<Impact> ways = impacts(striker, struck, config.impact);
    const bool too_many = ends.size() >= most_ends;
    if (too_many && pair->meeting.hit > 0.5) {
      world = touched(world, *pair, *std::max_element(ways.begin(), ways.end(), less_probable));
      continue;
    }
    if (too_many) ways.clear();
    for (const Impact& impact : ways) {
      World branch = touched(world, *pair, impact);
      branch.log_likelihood += std::log(std::max(least_probability, pair->meeting.hit * impact.probability));
      run(std::move(branch), to, config, ends);
    }
    world.log_likelihood += std::log(std::max(least_probability, 1.0 - pair->meeting.hit));
  }
  ends.push_back(std::move(world));
}

double team_cost(const WorldStone& stone, const StoneLook& look, const WorldConfig& config) {
  if (stone.team == Team::unknown || look.team == Team::unknown || stone.team == look.team) return 0.0;
  return -std::log(config.other_team_share);
}

/// Each look is of a stone, or of none: a column for each stone, and one of its own.
std::vector<int> assign(const World& world, const std::vector<StoneLook>& looks, const WorldConfig& config,
                        double& log_likelihood) {
  const std::size_t stones = world.stones.size();
  const double none = -std::log(config.clutter_per_m2);
  const double seen = -std::log(config.seen_share / (1.0 - config.seen_share));
  std::vector<std::vector<double>> costs(looks.size(), std::vector<double>(stones + looks.size(), impossible_cost));
  for (std::size_t i = 0; i < looks.size(); ++i) {
    for (std::size_t j = 0; j < stones; ++j) {
      const Innovation expected = innovation(world.stones[j].motion, looks[i].look);
      if (!(expected.square < gate_square)) continue;
      costs[i][j] = seen - expected.log_density + team_cost(world.stones[j], looks[i], config);
    }
    costs[i][stones + i] = none;
  }
  std::vector<int> column = least_cost_assignment(costs);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    log_likelihood -= costs[i][static_cast<std::size_t>(column[i])];
    if (column[i] >= static_cast<int>(stones)) column[i] = -1;
  }
  return column;
}

void judge_rest(WorldStone& stone) {
  if (!stone.motion.at_rest()) {
    stone.looks_at_rest = 0;
    stone.resting_since.reset();
    return;
  }
  if (!stone.resting_since) stone.resting_since = stone.motion.stamp;
  ++stone.looks_at_rest;
  const bool long_enough = stone.motion.stamp - *stone.resting_since >= time_to_rest;
  if (stone.looks_at_rest >= looks_to_rest && long_enough) stone.phase = StonePhase::standing;
}

void see(WorldStone& stone, const StoneLook& look, const WorldConfig& config) {
  correct(stone.motion, look.look);
  stone.last_seen = look.look.stamp;
  if (stone.team == Team::unknown) stone.team = look.team;
  if (stone.has_moved) stone.looks = std::make_shared<SeenLook>(SeenLook{look, stone.looks});
  if (stone.phase != StonePhase::moving) return;
  judge_rest(stone);
  judge_margins(stone, config);
}

}  // namespace

void judge_margins(WorldStone& stone, const WorldConfig& config) {
  const double sigma_x = std::sqrt(stone.motion.covariance(0, 0)), sigma_y = std::sqrt(stone.motion.covariance(1, 1));
  const double back = stone.motion.stone.y_m + stone_radius_m + back_line_m;
  if (back < stone.back_margin_m) stone.back_margin_m = back, stone.back_sigma_m = sigma_y;
  if (config.sheet_width_m) {
    const double side = 0.5 * *config.sheet_width_m - std::abs(stone.motion.stone.x_m) - stone_radius_m;
    if (side < stone.side_margin_m) stone.side_margin_m = side, stone.side_sigma_m = sigma_x;
  }
  if (stone.side_margin_m <= 0.0 || stone.back_margin_m <= 0.0) stone.phase = StonePhase::gone;
}

const WorldStone* World::find(int id) const {
  const auto at = std::find_if(stones.begin(), stones.end(), [&](const WorldStone& s) { return s.id == id; });
  return at == stones.end() ? nullptr : &*at;
}

const WorldStone* World::thrown() const {
  const auto at = std::find_if(stones.begin(), stones.end(), [](const WorldStone& s) { return s.thrown; });
  return at == stones.end() ? nullptr : &*at;
}

std::vector<World> advanced(const World& world, Stamp to, const WorldConfig& config) {
  std::vector<World> ends;
  run(world, to, config, ends);
  return ends;
}

void take(World& world, const std::vector<StoneLook>& looks, const WorldConfig& config) {
  const std::vector<int> column = assign(world, looks, config, world.log_likelihood);
  bool running = false;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (column[i] >= 0) {
      running |= world.stones[static_cast<std::size_t>(column[i])].phase == StonePhase::moving;
      see(world.stones[static_cast<std::size_t>(column[i])], looks[i], config);
    } else {
      world.strays.push_back(looks[i]);
    }
  }
  world.looks_since_split += running;
  identify_strays(world, config);
}

}  // namespace hogline::servo
