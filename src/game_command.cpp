#include "src/game_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "src/exit_status.hpp"
#include "src/game/simulated_throws.hpp"
#include "src/output/output_file.hpp"
#include "src/output/output_folder.hpp"
#include "src/team/throw_table.hpp"

namespace hogline {
namespace {

/// The practice robot's stone: where it is let go, and how truly, by the campaigns of doc/performance.md.
servo::ThrowerSkill practice_skill() {
  return {.release = {0.0, 9.159},
          .max_speed_mps = 3.4,
          .spin_radps = 1.5,
          .speed_sigma_mps = 0.006,
          .heading_sigma_rad = 0.03 * std::numbers::pi / 180.0};
}

int print_end(const game::Referee& referee) {
  const auto& state = referee.state();
  fmt::print(stderr, "team0 {} : {} team1", total(state, Team::first), total(state, Team::second));
  if (referee.phase() == game::RefereePhase::stopped)
    fmt::print(stderr, ", stopped: {}\n", referee.reason());
  else
    fmt::print(stderr, " after {} end{}{}{}\n", state.end, state.end == 1 ? "" : "s",
               referee.reason().empty() ? "" : ", ", referee.reason());
  return referee.phase() == game::RefereePhase::over ? ExitStatus::success : ExitStatus::not_achieved;
}

int tell_no_game(const std::string& failure) {
  fmt::print(stderr, "stopped before the first end: {}\n", failure);
  return ExitStatus::not_achieved;
}

int play_on_outcome_model(const GameOptions& options) {
  const servo::ThrowerSkill skill = practice_skill();
  const game::SimulatedSheet sheet = game::any_sheet(options.team.seed);
  game::SimulatedThrows throws(sheet, skill, servo::IceModel({}), options.team.seed);
  const auto ice = [&throws] { return throws.ice(); };
  GameTable table(options, *sheet.width_m, skill, ice);
  if (const std::string failure = table.practise(options, skill, ice, throws); !failure.empty()) {
    table.close();
    return tell_no_game(failure);
  }
  game::Referee referee(table.setting(), table.strategists(), throws, table.journal());
  table.play(referee);
  table.close();
  return print_end(referee);
}

/// A table that has each row as soon as there is one: who ends the program has what was thrown till then.
class RowFile {
 public:
  RowFile(const std::filesystem::path& path, const std::string& header) : path_(path) {
    stream_.open(path, std::ios::binary);
    add(header);
  }
  void add(const std::string& row) {
    stream_ << row << std::flush;
    check();
  }
  void close() {
    stream_.close();
    check();
  }

 private:
  void check() const {
    if (!stream_) throw std::runtime_error(path_.string() + ": can not be written; check the disk's space");
  }

  std::filesystem::path path_;
  std::ofstream stream_;
};

/// `end`: -1 before the first.
void tell_throw(const TurnRecord& r, int end, int shot) {
  if (end < 0)
    fmt::print(stderr, "practice {:2}:                  ", shot + 1);
  else
    fmt::print(stderr, "end {:2} shot {:2}: {:10} ", end + 1, shot + 1, r.turn.decision.plan);
  if (r.lesson) fmt::print(stderr, "{:.2f} m from where it was foretold", r.lesson->error_m());
  if (r.report.seen.struck) fmt::print(stderr, "struck");
  if (r.report.end != game::ThrowEnd::thrown) fmt::print(stderr, "not thrown: {}", r.report.reason);
  fmt::print(stderr, "; friction {:.3f}, curl {:.2f}; {:.0f} s in {:.1f} s", r.ice.friction_scale, r.ice.curl_gain,
             r.simulated_s, r.wall_s);
  for (const std::string& remark : r.remarks) fmt::print(stderr, "\n    {}", remark);
  fmt::print(stderr, "\n");
  std::fflush(stderr);
}

void tell_stage(double t_s, const std::string& what) {
  fmt::print(stderr, "{:7.2f} s  {}\n", t_s, what);
  std::fflush(stderr);
}

int play_with_robots(const GameOptions& options) {
  const TeamRequest request = team_request(options.team);
  SimulatedTeam team(request);
  const servo::ThrowerSkill skill = skill_of(request.thrower);
  std::vector<TurnRecord> records;
  const std::filesystem::path out(options.out);
  RowFile rows(out / "throws.csv", throw_header());
  TruthCheck* check = nullptr;
  const game::Referee* told = nullptr;
  RobotsThrow::Progress progress;  // by the oracle a throw is over sooner than it is told
  if (request.eyes == Eyes::vision) progress = tell_stage;
  RobotsThrow robots(
      team, skill, servo::IceModel({}),
      [&](const TurnRecord& record) {
        const int end = told ? told->state().end : -1;
        const int shot = told ? told->state().shot : static_cast<int>(records.size());
        if (check) check->record(record);
        records.push_back(record);
        rows.add(throw_row(record, end, shot));
        tell_throw(record, end, shot);
      },
      progress);
  const auto ice = [&robots] { return robots.ice(); };
  GameTable table(options, request.scenario.sheet.width_m, skill, ice);
  TruthCheck truth(table.setting(), table.journal());
  fmt::print(stderr, "on the simulated rink: no device of the rigs is opened\n");
  const std::string failure = table.practise(options, skill, ice, robots);
  game::Referee referee(table.setting(), table.strategists(), robots, truth);
  check = &truth;
  told = &referee;
  if (failure.empty()) table.play(referee);
  table.close();

  rows.close();
  std::string summary = figures_table(truth.figures(), records) + "\n" + ice_table(records);
  for (const Disagreement& d : truth.figures().disagreements) {
    summary += fmt::format("\nend {}, shot {}: {}, decided by {:.0f} mm{}\n", d.end + 1, d.shot + 1, d.what,
                           1e3 * d.margin_m, d.a_measure ? " (a measure)" : "");
  }
  replace_text(out / "summary.md", summary);
  replace_text(out / "figures.json", figures_json(truth.figures(), records));
  fmt::print(stderr, "\n{}\n", summary);
  return failure.empty() ? print_end(referee) : tell_no_game(failure);
}

}  // namespace

int run_game(const GameOptions& options) {
  check_seats(options);
  const OutputFolder folder("--out", options.out);
  return options.outcome_model ? play_on_outcome_model(options) : play_with_robots(options);
}

}  // namespace hogline
