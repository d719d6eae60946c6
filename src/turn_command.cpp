#include "src/turn_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "src/exit_status.hpp"
#include "src/game/built_in_strategist.hpp"
#include "src/game_table.hpp"
#include "src/output/output_folder.hpp"
#include "src/throw_request.hpp"
#include "src/turn_report.hpp"

namespace hogline {
namespace {

constexpr double deg = 180.0 / std::numbers::pi;

/// Stones of both teams by turns, anywhere in the house or before it, none near another.
servo::Board some_board(int stones, std::uint64_t seed) {
  std::mt19937_64 random(seed * 977 + 3);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  servo::Board board;
  std::vector<servo::BoardStone> lying;
  for (int n = 0; n < stones; ++n) {
    servo::BoardStone stone;
    const auto crowded = [&](const servo::BoardStone& other) {
      return std::hypot(stone.x_m - other.x_m, stone.y_m - other.y_m) < 0.6;
    };
    do {
      stone = {between(-1.6, 1.6), servo::in_sheet::tee_y_m + between(-4.0, 1.4), between(-3.0, 3.0)};
    } while (std::ranges::any_of(lying, crowded));
    lying.push_back(stone);
    board.stones[static_cast<std::size_t>(n % servo::team_count)][static_cast<std::size_t>(n / servo::team_count)] =
        stone;
  }
  return board;
}

/// Takes what the referee tells of the one throw.
class OneThrow final : public game::GameListener {
 public:
  void begun(const std::array<std::string, servo::team_count>&) override {}
  void stands(const servo::GameUpdate&) override {}
  void decided(const game::Turn&) override {}
  void thrown(const game::Turn&, const game::ThrowReport&, const servo::Judged&) override { done_ = true; }
  void stopped(const std::string&) override {}
  bool done() const { return done_; }

 private:
  bool done_ = false;
};

struct PlayedTurn {
  TurnRecord record;
  std::string stopped;  ///< why nothing was thrown; else empty
};

PlayedTurn play_turn(const TurnOptions& options) {
  const OutputFolder folder("--out", options.out);
  const TeamRequest request = team_request(options.team);
  SimulatedTeam team(request);
  const servo::ThrowerSkill skill = skill_of(request.thrower);
  ToldTurn told;
  PlayedTurn played;
  RobotsThrow robots(
      team, skill, servo::IceModel({}), [&](const TurnRecord& record) { played.record = record; },
      [&](double t_s, const std::string& what) {
        if (what.starts_with("ordered")) told.house_before = team.skip_sights().house;
        fmt::print(stderr, "{:7.2f} s  {}\n", t_s, what);
        std::fflush(stderr);
      });

  TableOptions seats;
  seats.ends = 1;
  seats.out.clear();
  seats.address = options.address;
  (options.stones % 2 == 0 ? seats.first : seats.second) = options.strategist;
  GameTable table(seats, request.scenario.sheet.width_m, skill, [&robots] { return robots.ice(); });
  servo::GameState state = servo::new_game(table.setting());
  state.board = some_board(options.stones, options.team.seed);
  state.shot = options.stones;
  team.crew().lay(state.board);
  OneThrow listener;
  game::Referee referee(table.setting(), state, table.strategists(), robots, listener);
  fmt::print(stderr, "on the simulated rink: no device of the rigs is opened\n");
  table.play(referee, [&listener] { return listener.done(); });
  if (referee.phase() == game::RefereePhase::stopped) played.stopped = referee.reason();
  told.record = &played.record;
  told.team = &team;
  if (played.record.attempts > 0) write_turn(options.out, told);
  return played;
}

bool well(const PlayedTurn& played) {
  return played.stopped.empty() && played.record.report.end == game::ThrowEnd::thrown && played.record.followed &&
         played.record.followed->ok;
}

void tell_release(const TurnRecord& r) {
  if (!r.thrower.release) return;
  const ReleaseOutcome& o = *r.thrower.release;
  fmt::print("Released {:.3f} m before the hog line; against the simulator's truth:\n", o.hog_distance_m);
  fmt::print("  place    {:+8.1f} mm\n", 1e3 * (o.hog_distance_m - o.target_hog_distance_m));
  fmt::print("  speed    {:+8.1f} mm/s\n", 1e3 * o.speed_error_mps);
  fmt::print("  heading  {:+8.3f} deg\n", o.heading_error_rad * deg);
  fmt::print("  lateral  {:+8.1f} mm\n", 1e3 * o.lateral_error_m);
}

void tell_followed(const TurnRecord& r) {
  if (!r.followed) return;
  const servo::ThrowResult& result = r.followed->result;
  if (result.hog_to_hog_s) fmt::print("Hog to hog in {:.2f} s", result.hog_to_hog_s->value);
  if (result.curl_m) fmt::print(", {:.2f} m of curl", std::abs(result.curl_m->value));
  fmt::print(", {} collision{}.\n", result.collisions.size(), result.collisions.size() == 1 ? "" : "s");
  double worst_m = 0.0;
  int lying = 0;
  for (const std::size_t side : {0u, 1u}) {
    for (std::size_t i = 0; i < servo::stones_each; ++i) {
      const auto &s = r.report.seen.lying.stones[side][i], &t = r.truth.stones.lying.stones[side][i];
      if (!s || !t) continue;
      ++lying;
      worst_m = std::max(worst_m, std::hypot(s->x_m - t->x_m, s->y_m - t->y_m));
    }
  }
  fmt::print("{} stones lie on the sheet; the skip sees each within {:.0f} mm of the truth.\n", lying, 1e3 * worst_m);
  fmt::print("The ice as learnt from this throw: friction {:.3f} +- {:.3f}, curl {:.2f} +- {:.2f} of FCV1's.\n",
             r.ice.friction_scale, std::sqrt(r.ice.covariance[0]), r.ice.curl_gain, std::sqrt(r.ice.covariance[4]));
}

}  // namespace

int run_turn(const TurnOptions& options) {
  const PlayedTurn played = play_turn(options);
  if (!played.stopped.empty()) fmt::print(stderr, "stopped: {}\n", played.stopped);
  fmt::print("{}\n", turn_json(played.record));
  return well(played) ? ExitStatus::success : ExitStatus::not_achieved;
}

int run_demo(const TurnOptions& options) {
  const PlayedTurn played = play_turn(options);
  const TurnRecord& r = played.record;
  fmt::print("\nThe strategist: {}. The order: {:.2f} m/s at the release, {:+.2f} deg, curl {}.\n",
             r.turn.decision.plan.empty() ? "as its program says" : r.turn.decision.plan, r.report.order.speed_mps,
             r.report.order.heading_rad * deg, r.report.order.curl == servo::Curl::clockwise ? "cw" : "ccw");
  tell_release(r);
  tell_followed(r);
  for (const std::string& remark : r.remarks) fmt::print("{}\n", remark);
  if (!played.stopped.empty()) fmt::print("Stopped: {}\n", played.stopped);
  fmt::print("\n{:.1f} s simulated in {:.1f} s. Everything is in {}: begin with {}/overview.png.\n", r.simulated_s,
             r.wall_s, options.out, options.out);
  return well(played) ? ExitStatus::success : ExitStatus::not_achieved;
}

}  // namespace hogline
