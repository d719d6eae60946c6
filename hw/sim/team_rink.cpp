#include "hw/sim/team_rink.hpp"

#include <algorithm>
#include <cassert>
#include <numbers>

#include "hw/sim/mixed_bits.hpp"

namespace hogline::hw::sim {
namespace {

constexpr Duration substep_span = std::chrono::milliseconds(1);
constexpr double tee_to_tee_m = 34.747;  // World Curling
constexpr double set_down_m = 0.05;      // of a person with a mark on the ice; assumed
constexpr double set_down_rad = 2.0 * std::numbers::pi / 180.0;

}  // namespace

StoneTruth from_other_end(const StoneTruth& stone) {
  return {.x_m = -stone.x_m,
          .y_m = tee_to_tee_m - stone.y_m,
          .vx_mps = -stone.vx_mps,
          .vy_mps = -stone.vy_mps,
          .spin_radps = stone.spin_radps,
          .handle_rad = stone.handle_rad + std::numbers::pi};
}

TeamRink::TeamRink(Rink& thrower, SkipRink& skip, const RobotScenario& robot, std::uint64_t seed)
    : thrower_(thrower), skip_(skip), robot_(robot), seed_(seed) {
  assert(thrower_.now() == skip_.now());
  thrower_.stones_are(sheet_stones());
}

void TeamRink::step(Duration span) {
  assert(span > Duration{});
  for (const Stamp end = now() + span; now() < end;) substep(std::min(substep_span, Duration(end - now())));
}

// The ice first: what the thrower's cameras see at the end of the step is then where it is.
void TeamRink::substep(Duration span) {
  skip_.step(span);
  thrower_.stones_are(sheet_stones());
  thrower_.step(span);
  const Truth& truth = thrower_.truth();
  if (!truth.release || skip_.thrown()) return;
  skip_.deliver({.motion = from_other_end(truth.stone), .team = team_}, truth.release->stamp);
}

// One that somebody has caught is still told of, where that was: 40 m from the thrower's cameras.
SheetStones TeamRink::sheet_stones() const {
  SheetStones sheet;
  const auto& stones = field().stones();
  for (std::size_t i = 0; i < stones.size(); ++i) {
    if (i == thrown()) {
      sheet.thrown = from_other_end(stones[i].motion);
    } else if (!stones[i].taken_off) {
      sheet.others.push_back(from_other_end(stones[i].motion));
      sheet.other_teams.push_back(stones[i].team);
    }
  }
  return sheet;
}

void TeamRink::put_back(int team) {
  std::uint64_t drawn = mixed_bits(seed_ ^ 0x7465616dULL) + 16 * ++throws_;
  const auto about = [&](double middle, double spread) {
    return middle + spread * (2.0 * uniform_of(mixed_bits(++drawn)) - 1.0);
  };
  const PlanarPose body{about(robot_.start_x_m, set_down_m), about(robot_.start_y_m, set_down_m),
                        about(robot_.start_yaw_rad, set_down_rad)};
  team_ = team;
  skip_.begin_throw(drawn);
  thrower_.put_back(body, team, about(0.0, std::numbers::pi));
  thrower_.stones_are(sheet_stones());
}

bool TeamRink::stone_runs() const { return !field().at_rest(); }

}  // namespace hogline::hw::sim
