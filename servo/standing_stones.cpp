#include "servo/standing_stones.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace hogline::servo {
namespace {

constexpr double same_stone_m = 0.145;  // two stones' centres are never nearer than twice that
constexpr double shared_variance = 0.5;

Eigen::Matrix2d matrix(const PlaceCovariance& c) {
  return (Eigen::Matrix2d() << c.xx_m2, c.xy_m2, c.xy_m2, c.yy_m2).finished();
}

Team majority(const std::vector<StoneSighting>& seen) {
  std::array<int, 3> votes{};
  for (const StoneSighting& s : seen) ++votes[static_cast<std::size_t>(s.team)];
  if (votes[0] == votes[1]) return Team::unknown;
  return votes[0] > votes[1] ? Team::first : Team::second;
}

StoneSighting mean(const std::vector<StoneSighting>& seen) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector2d weighted = Eigen::Vector2d::Zero();
  Eigen::Matrix2d one_look = Eigen::Matrix2d::Zero();
  for (const StoneSighting& s : seen) {
    const Eigen::Matrix2d weight = matrix(s.covariance).inverse();
    information += weight;
    weighted += weight * Eigen::Vector2d(s.x_m, s.y_m);
    one_look += matrix(s.covariance) / static_cast<double>(seen.size());
  }
  const Eigen::Matrix2d covariance = information.inverse();
  const Eigen::Vector2d place = covariance * weighted;
  const Eigen::Matrix2d honest = covariance + shared_variance * one_look;
  StoneSighting stone = seen.back();
  stone.x_m = place.x(), stone.y_m = place.y();
  stone.covariance = {honest(0, 0), honest(0, 1), honest(1, 1)};
  stone.team = majority(seen);
  return stone;
}

}  // namespace

void StandingStones::add(const StonesPercept& look) {
  if (!look.ok) return;
  ++looks_;
  for (const StoneSighting& seen : look.stones) {
    const bool usable = std::isfinite(seen.x_m + seen.y_m) && matrix(seen.covariance).determinant() > 0.0;
    if (!usable) continue;
    const auto near = [&](const Group& g) {
      return std::hypot(g.seen.front().x_m - seen.x_m, g.seen.front().y_m - seen.y_m) < same_stone_m;
    };
    const auto group = std::find_if(groups_.begin(), groups_.end(), near);
    if (group == groups_.end()) {
      groups_.push_back({{seen}});
    } else {
      group->seen.push_back(seen);
    }
  }
}

std::vector<StoneSighting> StandingStones::stones() const {
  std::vector<StoneSighting> stones;
  for (const Group& g : groups_) {
    if (2 * static_cast<int>(g.seen.size()) >= looks_) stones.push_back(mean(g.seen));
  }
  std::sort(stones.begin(), stones.end(), [](const auto& a, const auto& b) { return a.y_m < b.y_m; });
  return stones;
}

}  // namespace hogline::servo
