// Which stone is which one of the last picture's, and how it moves.
#include <algorithm>
#include <cmath>

#include "vision/stone_sequence_impl.hpp"

namespace hogline::vision {
namespace {

constexpr double remembered_s = 1.0;            // of a stone that runs
constexpr double remembered_standing_s = 30.0;  // somebody may stand before it
constexpr double moved_sigmas = 4.0;            // of a place's own noise
constexpr double least_moved_m = 0.004;
constexpr double velocity_share = 0.4;  // of what is new, each time
constexpr double most_speed_mps = 4.5;

}  // namespace

// Which one of the last picture's a stone is that was found by votes: one that was lost and not yet found again.
std::optional<std::size_t> StoneSequence::Impl::formerly(const JudgedStone& stone, Stamp stamp,
                                                         const std::vector<bool>& again) const {
  std::optional<std::size_t> nearest;
  double least_m = most_reach_m;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (again[i] || !known[i].in_sight) continue;
    const double apart_m = (known[i].seen.fit.place - stone.fit.place).norm();
    if (apart_m < std::min(least_m, most_speed_mps * seconds(stamp - known[i].stamp))) least_m = apart_m, nearest = i;
  }
  return nearest;
}

// A place's own noise is no motion.
Eigen::Vector2d StoneSequence::Impl::velocity_of(const Known& before, const Known& now) const {
  const double dt_s = seconds(now.stamp - before.stamp);
  const Eigen::Vector2d moved = now.seen.fit.place - before.seen.fit.place;
  const double noise_m2 = (now.seen.fit.covariance + before.seen.fit.covariance).trace();
  const bool stood = before.velocity.isZero();
  if (stood && moved.norm() < std::max(least_moved_m, moved_sigmas * std::sqrt(0.5 * noise_m2))) return {0.0, 0.0};
  const Eigen::Vector2d velocity = moved / dt_s;
  if (velocity.norm() > most_speed_mps) return {0.0, 0.0};
  const Eigen::Vector2d smooth = stood ? velocity : before.velocity + velocity_share * (velocity - before.velocity);
  return smooth.norm() * dt_s < 0.25 * least_moved_m ? Eigen::Vector2d(0.0, 0.0) : smooth;
}

void StoneSequence::Impl::remember(Stamp stamp, const Scene& scene) {
  std::vector<Known> next;
  std::vector<bool> again(known.size(), false);
  for (const auto& which : scene.known) {
    if (which) again[*which] = true;
  }
  for (std::size_t i = 0; i < scene.stones.size(); ++i) {
    const JudgedStone& s = scene.stones[i];
    if (!s.doubt.empty() && !scene.known[i]) refused.push_back({s.candidate.place, stamp});
    if (!s.doubt.empty()) {
      if (scene.known[i]) again[*scene.known[i]] = false;
      continue;
    }
    Known now{s, stamp};
    const auto which = scene.known[i] ? scene.known[i] : formerly(s, stamp, again);
    if (which) now.velocity = velocity_of(known[*which], now);
    if (which) again[*which] = true;
    next.push_back(now);
  }
  for (std::size_t i = 0; i < known.size(); ++i) {
    Known& k = known[i];
    const double limit_s = k.velocity.isZero() ? remembered_standing_s : remembered_s;
    if (again[i] || seconds(stamp - k.stamp) > limit_s || scene.taken(k.seen.fit.place)) continue;
    k.in_sight = false;
    next.push_back(k);
  }
  known = std::move(next);
  last = stamp;
}

}  // namespace hogline::vision
