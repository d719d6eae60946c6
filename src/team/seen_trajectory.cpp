#include "src/team/seen_trajectory.hpp"

#include <algorithm>

namespace hogline {
namespace {

constexpr double frame_s = 0.1;

servo::BoardStone between(const servo::TrajectoryPoint& a, const servo::TrajectoryPoint& b, Stamp at) {
  const double span_s = seconds(b.stamp - a.stamp);
  const double share = span_s > 0.0 ? seconds(at - a.stamp) / span_s : 1.0;
  return on_board(a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m), 0.0);
}

std::vector<servo::StoneChange> changes(const servo::Board& before, const servo::Board& after) {
  std::vector<servo::StoneChange> all;
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < servo::stones_each; ++i) {
      const auto& now = after.stones[side][i];
      if (before.stones[side][i] != now) all.push_back({servo::team_of(side), i, now});
    }
  }
  return all;
}

}  // namespace

std::optional<servo::Trajectory> seen_trajectory(const SeenThrow& seen, const servo::Board& lying) {
  if (!seen.followed || seen.followed->trajectory.empty()) return std::nullopt;
  const auto& points = seen.followed->trajectory;
  servo::Trajectory trajectory{frame_s, seen.before, {}, {}};
  auto& thrown = trajectory.start.stones[seen.thrown.side][seen.thrown.stone];
  thrown = on_board(points.front().x_m, points.front().y_m, 0.0);
  servo::Board now = trajectory.start;
  std::size_t next = 1;
  for (Stamp at = points.front().stamp + from_seconds(frame_s); at <= points.back().stamp;
       at += from_seconds(frame_s)) {
    while (next + 1 < points.size() && points[next].stamp < at) ++next;
    servo::Board then = now;
    then.stones[seen.thrown.side][seen.thrown.stone] = between(points[next - 1], points[next], at);
    trajectory.frames.push_back(changes(now, then));
    now = then;
  }
  trajectory.frames.push_back(changes(now, lying));
  return trajectory;
}

}  // namespace hogline
