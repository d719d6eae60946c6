#include "servo/stray_looks.hpp"

#include <algorithm>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr Duration one_moment = std::chrono::microseconds(1);     // two views' pictures of it follow each other by less
constexpr Duration remembered = std::chrono::milliseconds(1250);  // six looks at four a second
constexpr Duration shortest_line = std::chrono::milliseconds(120);
constexpr std::size_t least_looks = 5;
constexpr double fastest_mps = 4.5;
constexpr double slowest_thrown_mps = 0.4;
constexpr double on_line_square = 12.0;
constexpr double reach_m = 0.5;
constexpr double reach_mps = 0.5;

struct Line {
  std::vector<StoneLook> looks;
  double vx_mps = 0.0;
  double vy_mps = 0.0;
};

double square_from(const StoneLook& look, double x, double y, double vx, double vy, Stamp stamp) {
  const double t = seconds(look.look.stamp - stamp);
  const double dx = look.look.x_m - x - vx * t, dy = look.look.y_m - y - vy * t;
  const PlaceCovariance& c = look.look.covariance;
  const double det = c.xx_m2 * c.yy_m2 - c.xy_m2 * c.xy_m2;
  // Half: the line's own places are looks too.
  return 0.5 * (c.yy_m2 * dx * dx - 2.0 * c.xy_m2 * dx * dy + c.xx_m2 * dy * dy) / det;
}

/// Through the newest stray and an older one; all strays near it.
Line line_through(const std::vector<StoneLook>& strays, const StoneLook& older) {
  const TrackLook &a = older.look, &b = strays.back().look;
  const double t = seconds(b.stamp - a.stamp);
  Line line{{}, (b.x_m - a.x_m) / t, (b.y_m - a.y_m) / t};
  if (std::hypot(line.vx_mps, line.vy_mps) > fastest_mps) return line;
  for (const StoneLook& look : strays) {
    const bool same_picture = !line.looks.empty() && line.looks.back().look.stamp == look.look.stamp;
    if (same_picture || look.team != strays.back().team) continue;
    if (square_from(look, b.x_m, b.y_m, line.vx_mps, line.vy_mps, b.stamp) < on_line_square) line.looks.push_back(look);
  }
  return line;
}

std::optional<Line> best_line(const std::vector<StoneLook>& strays) {
  std::optional<Line> best;
  for (const StoneLook& older : strays) {
    if (strays.back().look.stamp - older.look.stamp < shortest_line) break;
    Line line = line_through(strays, older);
    if (line.looks.size() < least_looks) continue;
    if (!best || line.looks.size() > best->looks.size()) best = std::move(line);
  }
  return best;
}

/// Starts again from the line's looks.
void set_off(WorldStone& stone, const Line& line, double spin_radps, const WorldConfig& config, Stamp now) {
  const TrackLook& first = line.looks.front().look;
  stone.motion = running_stone(first.stamp, {first.x_m, first.y_m, line.vx_mps, line.vy_mps, spin_radps}, 1.0, 0.7,
                               config.ice, config.throw_friction_sigma);
  stone.phase = StonePhase::moving;
  stone.has_moved = true;
  stone.looks_at_rest = 0;
  stone.resting_since.reset();
  for (const StoneLook& look : line.looks) {
    advance(stone.motion, look.look.stamp, config.noise);
    correct(stone.motion, look.look);
    stone.looks = std::make_shared<SeenLook>(SeenLook{look, stone.looks});
  }
  stone.last_seen = line.looks.back().look.stamp;
  if (stone.team == Team::unknown) stone.team = line.looks.back().team;
  advance(stone.motion, now, config.noise);
}

bool comes_from_the_thrower(const Line& line) { return line.vy_mps < -slowest_thrown_mps; }

bool may_be(const WorldStone& stone, const Line& line) {
  const Team team = line.looks.back().team;
  return stone.team == Team::unknown || team == Team::unknown || stone.team == team;
}

/// How far the line begins from where the stone should have been; negative when it can not be that stone.
double miss_m(const WorldStone& stone, const Line& line, Stamp now) {
  const TrackLook& first = line.looks.front().look;
  if (stone.phase == StonePhase::gone || !may_be(stone, line) || stone.last_seen >= first.stamp) return -1.0;
  const double since_s = seconds(now - first.stamp);
  const SlidingStone& at = stone.motion.stone;
  const double miss = std::hypot(first.x_m - at.x_m + at.vx_mps * since_s, first.y_m - at.y_m + at.vy_mps * since_s);
  const double unseen_s = seconds(first.stamp - stone.last_seen);
  return miss < reach_m + reach_mps * std::min(unseen_s, 3.0) ? miss : -1.0;
}

WorldStone* missing_one(World& world, const Line& line) {
  WorldStone* best = nullptr;
  double least_m = 0.0;
  for (WorldStone& stone : world.stones) {
    const double miss = miss_m(stone, line, world.stamp);
    if (miss >= 0.0 && (!best || miss < least_m)) best = &stone, least_m = miss;
  }
  return best;
}

/// A standing stone that is found running was hit, whoever saw it: by the running stone nearest to it.
void note_hit(World& world, const WorldStone& struck) {
  const WorldStone* striker = nullptr;
  double nearest_m = 1.5;
  for (const WorldStone& stone : world.stones) {
    if (stone.id == struck.id || !stone.has_moved) continue;
    const double gap =
        std::hypot(stone.motion.stone.x_m - struck.motion.stone.x_m, stone.motion.stone.y_m - struck.motion.stone.y_m);
    if (gap < nearest_m) striker = &stone, nearest_m = gap;
  }
  if (!striker) return;
  const SlidingStone &at = struck.motion.stone, &from = striker->motion.stone;
  world.collisions.push_back(
      {struck.last_seen, striker->id, struck.id, 0.5 * (at.x_m + from.x_m), 0.5 * (at.y_m + from.y_m), at.x_m, at.y_m});
}

void drop(World& world, const Line& line) {
  const auto used = [&](const StoneLook& stray) {
    return std::any_of(line.looks.begin(), line.looks.end(), [&](const StoneLook& look) {
      return look.look.stamp == stray.look.stamp && look.look.x_m == stray.look.x_m && look.look.y_m == stray.look.y_m;
    });
  };
  world.strays.erase(std::remove_if(world.strays.begin(), world.strays.end(), used), world.strays.end());
}

}  // namespace

void identify_strays(World& world, const WorldConfig& config) {
  const auto old = [&](const StoneLook& look) { return look.look.stamp < world.stamp - remembered; };
  world.strays.erase(std::remove_if(world.strays.begin(), world.strays.end(), old), world.strays.end());
  if (world.strays.size() < least_looks || world.stamp - world.strays.back().look.stamp > one_moment) return;
  const auto line = best_line(world.strays);
  if (!line) return;

  WorldStone* stone = missing_one(world, *line);
  if (stone) {
    if (stone->phase == StonePhase::standing && std::hypot(line->vx_mps, line->vy_mps) > 0.1) note_hit(world, *stone);
    const bool same_throw = stone->thrown && world.collisions.empty();
    set_off(*stone, *line, same_throw ? stone->motion.stone.spin_radps : 0.0, config, world.stamp);
  } else if (!world.thrown() && comes_from_the_thrower(*line)) {
    WorldStone thrown;
    thrown.id = static_cast<int>(world.stones.size());
    thrown.thrown = true;
    set_off(thrown, *line, config.expected_spin_radps, config, world.stamp);
    world.stones.push_back(std::move(thrown));
  } else {
    return;
  }
  drop(world, *line);
}

}  // namespace hogline::servo
