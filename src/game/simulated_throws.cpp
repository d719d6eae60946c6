#include "src/game/simulated_throws.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace hogline::game {
namespace {

using namespace servo;
using hw::sim::BoardRun;
using hw::sim::BoardStones;
using hw::sim::StoneTruth;

constexpr double frame_s = 0.1;

std::size_t slot_of(Team team, std::size_t stone) { return side_of(team) * stones_each + stone; }

BoardStones stones_of(const Board& board) {
  BoardStones stones(stones_an_end);
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < stones_each; ++i) {
      const auto& stone = board.stones[side][i];
      if (stone)
        stones[side * stones_each + i] =
            StoneTruth{.x_m = stone->x_m, .y_m = stone->y_m, .handle_rad = stone->angle_rad};
    }
  }
  return stones;
}

std::optional<BoardStone> lying(const std::optional<StoneTruth>& stone) {
  if (!stone) return std::nullopt;
  return BoardStone{stone->x_m, stone->y_m, stone->handle_rad};
}

Board board_of(const BoardStones& stones) {
  Board board;
  for (std::size_t i = 0; i < stones.size(); ++i) board.stones[i / stones_each][i % stones_each] = lying(stones[i]);
  return board;
}

std::vector<StoneChange> changes(const Board& before, const Board& after) {
  std::vector<StoneChange> all;
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < stones_each; ++i) {
      const auto& now = after.stones[side][i];
      if (before.stones[side][i] != now) all.push_back({team_of(side), i, now});
    }
  }
  return all;
}

Trajectory trajectory_of(const BoardStones& start, const BoardRun& run) {
  Trajectory trajectory{frame_s, board_of(start), {}, {}};
  Board before = trajectory.start;
  for (const BoardStones& frame : run.frames) {
    const Board after = board_of(frame);
    trajectory.frames.push_back(changes(before, after));
    before = after;
  }
  return trajectory;
}

hw::sim::StoneScenario scenario_of(const SimulatedSheet& sheet, double friction_scale) {
  hw::sim::StoneScenario scenario;
  scenario.mass_kg = 19.96;
  scenario.radius_m = in_sheet::stone_radius_m;
  scenario.friction_scale = friction_scale;
  scenario.curl_gain = sheet.ice.curl_gain;
  scenario.lateral_acceleration_mps2 = sheet.ice.lateral_mps2;
  scenario.spin_decay_scale = sheet.ice.spin_decay_scale;
  scenario.restitution = sheet.restitution;
  scenario.stone_friction = sheet.stone_friction;
  return scenario;
}

}  // namespace

SimulatedSheet any_sheet(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  SimulatedSheet sheet;
  sheet.ice = {between(0.85, 1.2), between(0.6, 1.1), between(-3e-4, 3e-4), between(0.7, 1.4)};
  sheet.restitution = between(0.80, 0.95);
  sheet.stone_friction = between(0.05, 0.2);
  return sheet;
}

SimulatedThrows::SimulatedThrows(const SimulatedSheet& sheet, const ThrowerSkill& skill, const IceModel& ice,
                                 std::uint64_t seed, const SkipEyes& eyes)
    : sheet_(sheet), skill_(skill), ice_(ice), eyes_(eyes), random_(seed) {}

void SimulatedThrows::start(const Turn& turn, Stamp) { report_ = thrown(turn); }

std::optional<ThrowReport> SimulatedThrows::step(Stamp) { return std::exchange(report_, std::nullopt); }

ThrowReport SimulatedThrows::thrown(const Turn& turn) {
  ThrowReport report;
  BoardStones stones = stones_of(turn.board);
  if (turn.decision.order) {
    report.order = *turn.decision.order;
  } else {
    Surroundings around{{}, sheet_.width_m};
    for (const auto& stone : stones)
      if (stone) around.stones.push_back({stone->x_m, stone->y_m});
    report.mapped = map_shot(std::get<HackShot>(turn.decision.move), around, skill_, ice_);
    report.reason = report.mapped->reason;
    report.end = ThrowEnd::refused;
    if (!report.mapped->ok) return report;
    report.order = report.mapped->order;
  }
  report.end = ThrowEnd::thrown;
  report.reason.clear();
  const std::size_t slot = slot_of(turn.team, turn.stone);
  stones[slot] = released(report.order);
  const double friction =
      sheet_.ice.friction_scale * (1.0 + sheet_.throw_friction_sigma * std::normal_distribution<double>()(random_));
  const BoardRun run = run_to_rest(stones, slot, scenario_of(sheet_, friction), {sheet_.width_m}, frame_s);
  learn(run, stones, slot, stones[slot]->spin_radps);
  report.seen = {board_of(run.stones), run.struck};
  report.trajectory = trajectory_of(stones, run);
  return report;
}

StoneTruth SimulatedThrows::released(const ShotOrder& order) {
  std::normal_distribution<double> normal;
  ShotOrder done = order;
  done.speed_mps += skill_.speed_sigma_mps * normal(random_);
  done.heading_rad += skill_.heading_sigma_rad * normal(random_);
  const SlidingStone stone = servo::released(done, release_place(skill_, order.heading_rad));
  return {stone.x_m, stone.y_m, stone.vx_mps, stone.vy_mps, stone.spin_radps, 0.0};
}

/// Up to the first frame in which another stone is not where it was.
void SimulatedThrows::learn(const BoardRun& run, const BoardStones& before, std::size_t stone, double spin_radps) {
  std::normal_distribution<double> normal(0.0, eyes_.sigma_m);
  ThrowTrack track{{}, spin_radps};
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const BoardStones& frame = run.frames[i];
    bool alone = frame[stone].has_value();
    for (std::size_t k = 0; k < frame.size() && alone; ++k) alone = k == stone || lying(frame[k]) == lying(before[k]);
    if (!alone) break;
    if (frame[stone]->y_m < eyes_.from_y_m) continue;
    TrackLook look;
    look.stamp = Stamp(from_seconds(frame_s * static_cast<double>(i + 1)));
    look.x_m = frame[stone]->x_m + normal(random_);
    look.y_m = frame[stone]->y_m + normal(random_);
    look.covariance = {eyes_.sigma_m * eyes_.sigma_m, 0.0, eyes_.sigma_m * eyes_.sigma_m};
    track.looks.push_back(look);
  }
  if (!track.looks.empty()) ice_.learn(track);
}

}  // namespace hogline::game
