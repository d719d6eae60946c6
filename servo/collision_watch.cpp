#include "servo/collision_watch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr int looks_to_merge = 6;
constexpr int looks_to_decide = 40;

bool positive_definite(const PlaceCovariance& c) {
  return c.xx_m2 > 0.0 && c.xx_m2 * c.yy_m2 - c.xy_m2 * c.xy_m2 > 0.0 && std::isfinite(c.xx_m2 * c.yy_m2);
}

World first_world(const WorldConfig& config, Stamp start, const std::vector<StoneSighting>& standing) {
  World world;
  world.stamp = start;
  for (const StoneSighting& seen : standing) {
    assert(std::isfinite(seen.x_m + seen.y_m) && positive_definite(seen.covariance));
    WorldStone stone;
    stone.id = static_cast<int>(world.stones.size());
    stone.team = seen.team;
    stone.motion = standing_stone(start, seen.x_m, seen.y_m, seen.covariance, config.ice);
    stone.last_seen = start;
    world.stones.push_back(std::move(stone));
  }
  return world;
}

bool less_likely(const World& a, const World& b) { return a.log_likelihood < b.log_likelihood; }

bool same_meetings(const World& a, const World& b) {
  const auto same = [](const WorldCollision& p, const WorldCollision& q) {
    return std::minmax(p.striker, p.struck) == std::minmax(q.striker, q.struck);
  };
  return std::equal(a.collisions.begin(), a.collisions.end(), b.collisions.begin(), b.collisions.end(), same);
}

/// Drops what is contradicted, what tells the same as a likelier account, and in the end all but the likeliest.
void settle(std::vector<World>& worlds, const CollisionWatchConfig& config) {
  std::sort(worlds.begin(), worlds.end(), [](const World& a, const World& b) { return less_likely(b, a); });
  const double best = worlds.front().log_likelihood;
  const int looks = worlds.front().looks_since_split;
  std::vector<World> kept;
  for (World& world : worlds) {
    if (kept.size() >= config.most_accounts || world.log_likelihood < best - config.doubt) break;
    const auto told = [&](const World& other) {
      return world.looks_since_split >= looks_to_merge && same_meetings(world, other);
    };
    if (std::any_of(kept.begin(), kept.end(), told)) continue;
    if (!kept.empty() && std::min(looks, world.looks_since_split) >= looks_to_decide) continue;
    kept.push_back(std::move(world));
  }
  worlds = std::move(kept);
}

void begin(World& world, const ReleaseSignal& signal, const WorldConfig& config) {
  if (world.thrown()) return;
  WorldStone stone;
  stone.id = static_cast<int>(world.stones.size());
  stone.team = signal.team;
  stone.thrown = stone.has_moved = true;
  stone.phase = StonePhase::moving;
  stone.motion = running_stone(signal.stamp, signal.stone, signal.place_sigma_m, signal.velocity_sigma_mps, config.ice,
                               config.throw_friction_sigma);
  stone.last_seen = signal.stamp;
  world.stones.push_back(std::move(stone));
}

}  // namespace

void CollisionWatch::Model::hold(State& worlds, double dt_s) const {
  std::vector<World> ends;
  for (const World& world : worlds) {
    for (World& end : advanced(world, world.stamp + from_seconds(dt_s), config.world)) ends.push_back(std::move(end));
  }
  worlds = std::move(ends);
  settle(worlds, config);
}

bool CollisionWatch::Model::correct(State& worlds, const Picture& picture) const {
  for (World& world : worlds) {
    if (picture.release) begin(world, *picture.release, config.world);
    if (!picture.release) take(world, picture.looks, config.world);
  }
  settle(worlds, config);
  return true;
}

CollisionWatch::CollisionWatch(const CollisionWatchConfig& config, Stamp start,
                               const std::vector<StoneSighting>& standing)
    : config_(config),
      fusion_(Model{config}, config.history, start, {first_world(config.world, start, standing)}),
      newest_(start) {}

Fusion CollisionWatch::take_in(Stamp stamp, Picture picture) {
  Fusion fusion = fusion_.measure(stamp, picture);
  // Both views of one moment: the second is taken in right after the first.
  for (int i = 0; fusion == Fusion::duplicate && i < view_count; ++i) {
    stamp += Duration(1);
    fusion = fusion_.measure(stamp, picture);
  }
  if (stamp > newest_) {
    newest_ = stamp;
    fusion_.input(stamp, {});
  }
  return fusion;
}

Fusion CollisionWatch::released(const ReleaseSignal& signal) { return take_in(signal.stamp, {{}, signal}); }

Fusion CollisionWatch::look(const StonesPercept& percept, View view) {
  if (!percept.ok) return Fusion::gated;
  const ViewGeometry& camera = config_.views[static_cast<std::size_t>(view)];
  const SharedTilt tilt{camera.camera_x_m, camera.camera_y_m, camera.tilt_sigma_rad / camera.camera_height_m};
  Picture picture;
  for (const StoneSighting& seen : percept.stones) {
    if (!std::isfinite(seen.x_m + seen.y_m) || !positive_definite(seen.covariance)) continue;
    picture.looks.push_back({{percept.stamp, seen.x_m, seen.y_m, seen.covariance, view, tilt},
                             seen.team,
                             seen.handle_rad,
                             seen.handle_sigma_rad});
  }
  return take_in(percept.stamp, std::move(picture));
}

World CollisionWatch::at(Stamp stamp) const {
  const std::vector<World> worlds = fusion_.at(stamp);
  return *std::max_element(worlds.begin(), worlds.end(), less_likely);
}

std::size_t CollisionWatch::accounts() const { return fusion_.at(newest_).size(); }

bool CollisionWatch::over(Stamp now, Duration lost_after) const {
  const World world = at(newest_);
  if (!world.thrown()) return false;
  return std::none_of(world.stones.begin(), world.stones.end(), [&](const WorldStone& stone) {
    return stone.phase == StonePhase::moving && now - stone.last_seen < lost_after;
  });
}

}  // namespace hogline::servo
