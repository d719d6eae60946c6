// Command lines of the skip on the simulated rink.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "src/cli/commands.hpp"
#include "src/cli/number_checks.hpp"
#include "src/live_skip_command.hpp"
#include "src/skip/skip_scene.hpp"
#include "src/skip/skip_set.hpp"
#include "src/skip_command.hpp"

namespace hogline::cli {

namespace {

void add_live_game(CLI::App* skip, CLI::Option* live, TableOptions& table, std::string& thrower_rig) {
  auto* thrower = skip->add_option("--thrower-rig", thrower_rig,
                                   "with --live: the thrower's rig file (YAML), by which a game's shots are ordered");
  thrower->needs(live);
  const auto seat = [&](const char* name, std::string& strategist, const char* words) {
    skip->add_option(name, strategist, words)->capture_default_str()->check(known_strategist)->needs(thrower);
  };
  seat("--team0", table.first, "of the game that `play` plays: who decides for the first team: built-in, or dc:PORT");
  seat("--team1", table.second, "the same for the second team, which has the first end's hammer");
  skip->add_option("--ends", table.ends, "how many it has")
      ->capture_default_str()
      ->check(CLI::Validator(whole_between(1, 20), "1 to 20"))
      ->needs(thrower);
  skip->add_option("--thinking", table.thinking_s, "each team's time for the whole game, s")
      ->capture_default_str()
      ->check(CLI::Validator(between(1.0, 86400.0), "1.0 to 86400.0"))
      ->needs(thrower);
  skip->add_option("--connect", table.connect_s, "how long clients are waited for, s")
      ->capture_default_str()
      ->check(CLI::Validator(between(1.0, 86400.0), "1.0 to 86400.0"))
      ->needs(thrower);
}

}  // namespace

void add_skip(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<SkipOptions>();
  SkipOptions& options = *kept;
  auto* skip = app.add_subcommand("skip", "the skip on the simulated rink: look, aim, follow the thrown stone to rest");
  skip->add_option("--rig", options.rig, "rig file (YAML); without it the practice skip");
  skip->add_option("--scenario", options.scenario,
                   "scenario file (YAML) of the simulated rink; without it the practice rink");
  skip->add_option("--throw", options.kind, "what is thrown; the seed draws the rest")
      ->capture_default_str()
      ->check(CLI::IsMember(throw_kind_names()));
  skip->add_option("--seed", options.seed, "of all that is random in the simulation, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  skip->add_option("--number", options.number, "this throw of the set that `hogline skips` measures, instead")
      ->check(CLI::Validator(whole_between(0, throws_in_set - 1), fmt::format("0 to {}", throws_in_set - 1)))
      ->excludes(skip->get_option("--throw"));
  skip->add_flag("--oracle", options.oracle, "the simulator's truth with errors instead of rendered pictures");
  skip->add_flag("--unannounced", options.unannounced,
                 "the thrower does not tell when it lets go, nor which way it turns");
  skip->add_option("--far-hz", options.far_hz, "rate of the far camera; without it the scenario's")
      ->check(CLI::Validator(between(2.0, 200.0), "2.0 to 200.0"));
  skip->add_option("--near-hz", options.near_hz, "rate of the near camera; without it the scenario's")
      ->check(CLI::Validator(between(2.0, 200.0), "2.0 to 200.0"));
  skip->add_option("--ice", options.ice,
                   "file of what throws have taught of the ice: read if it is there, and written after the throw");
  skip->add_option("--out", options.out, "folder for result.json, trajectory.csv and above.png")->capture_default_str();
  skip->add_option("--record", options.record, "folder for the pictures that were looked at, for `hogline track`");
  skip->add_flag("--json", options.json_only, "print nothing but the JSON object");
  const auto live = std::make_shared<bool>(false);
  auto* rig = skip->get_option("--rig");
  auto* stays = skip->add_flag("--live", *live, "no simulation: stay, and be the skip whose devices the rig names");
  stays->needs(rig);
  for (const char* simulated : {"--scenario", "--throw", "--seed", "--number", "--oracle", "--unannounced", "--far-hz",
                                "--near-hz", "--ice", "--record", "--json"}) {
    stays->excludes(skip->get_option(simulated));
  }
  const auto table = std::make_shared<TableOptions>();
  const auto thrower_rig = std::make_shared<std::string>();
  add_live_game(skip, stays, *table, *thrower_rig);
  skip->footer(
      "Examples:\n"
      "  hogline skip --throw double --seed 7 --oracle --out out/skip\n"
      "  hogline skip --throw draw --far-hz 10 --near-hz 10 --ice sheet4.yaml\n"
      "  hogline skip --live --rig config/rigs/skip_live.yaml\n"
      "It simulates: whatever devices the rig names, none of them is opened, and nothing real moves. With --live it "
      "is\n"
      "the robot's own program: THE HEAD MOVES when `begin` is said on its stdin, BOTH ROBOTS when `play` is "
      "(doc/programs.md).\n"
      "doc/skip.md says what the JSON object holds.\n"
      "Exit status: 0 the throw was followed to its end, 1 it was not (the reason says why), 2 wrong use or\n"
      "configuration, 3 something outside failed (a disk).");
  skip->callback([kept, live, table, thrower_rig, &chosen] {
    chosen = [kept, live, table, thrower_rig] {
      table->out = kept->out;
      table->print = false;
      return *live ? run_live_skip({kept->rig, *thrower_rig, *table}) : run_skip(*kept);
    };
  });
}

void add_skips(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<SkipsOptions>();
  SkipsOptions& options = *kept;
  auto* skips = app.add_subcommand("skips", "the set of 40 throws on which the skip is measured, as a table");
  skips->add_option("--rig", options.rig, "rig file (YAML); without it the practice skip");
  skips->add_option("--scenario", options.scenario, "scenario file (YAML); without it the practice rink");
  skips->add_option("--seed", options.seed, "of the first throw, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  skips->add_option("--only", options.only, "this many throws, spread over the set")
      ->check(CLI::Validator(whole_between(1, throws_in_set), fmt::format("1 to {}", throws_in_set)));
  skips->add_option("--jobs", options.jobs, "throws at a time")
      ->capture_default_str()
      ->check(CLI::Validator(whole_between(1, 256), "1 to 256"));
  skips->add_flag("--oracle", options.oracle, "the simulator's truth with errors instead of rendered pictures");
  skips->add_option("--far-hz", options.far_hz, "rate of the far camera")
      ->check(CLI::Validator(between(2.0, 200.0), "2.0 to 200.0"));
  skips->add_option("--near-hz", options.near_hz, "rate of the near camera")
      ->check(CLI::Validator(between(2.0, 200.0), "2.0 to 200.0"));
  skips->add_option("--out", options.out, "folder for throws.csv and table.md")->capture_default_str();
  skips->footer(
      "Example:\n"
      "  hogline skips --oracle --out out/skips\n"
      "Exit status: 0 every throw was followed and nothing taken for something else, 1 not, 2 wrong use or\n"
      "configuration, 3 something outside failed (a disk).");
  skips->callback([kept, &chosen] { chosen = [kept] { return run_skips(*kept); }; });
}

}  // namespace hogline::cli
