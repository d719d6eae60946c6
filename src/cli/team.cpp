// Command lines of what goes on between robots and strategists.
#include <CLI/CLI.hpp>
#include <memory>

#include "src/cli/commands.hpp"
#include "src/cli/number_checks.hpp"
#include "src/game_command.hpp"
#include "src/keys_command.hpp"
#include "src/link_command.hpp"
#include "src/turn_command.hpp"

namespace hogline::cli {

namespace {

/// A slower camera would be taken for one that has failed.
std::string camera_rate(std::string& text) {
  return between(0.0, 0.0)(text).empty() ? std::string() : between(2.0, 120.0)(text);
}

void add_robots(CLI::App* app, TeamOptions& options) {
  app->add_option("--rig", options.rig, "the thrower's rig file (YAML); without it the practice rig");
  app->add_option("--skip-rig", options.skip_rig, "the skip's rig file (YAML); without it the practice skip");
  app->add_option("--scenario", options.scenario,
                  "scenario file (YAML) with a skip section; without it the practice rink");
  app->add_option("--seed", options.seed, "of all that is random in the simulation, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  app->add_option("--seer", options.seer, "who looks: vision at rendered pictures (slow), or an oracle with its errors")
      ->capture_default_str()
      ->check(CLI::IsMember({"oracle", "rendered"}));
  app->add_option("--skip-hz", options.skip_hz,
                  "rate of the skip's cameras; 0: 20 by the oracle, 6 in rendered pictures")
      ->capture_default_str()
      ->check(CLI::Validator(camera_rate, "0, or 2 to 120"));
}

void add_turn_options(CLI::App* app, TurnOptions& options) {
  add_robots(app, options.team);
  app->add_option("--stones", options.stones, "so many of the end's stones lie in the house or before it")
      ->capture_default_str()
      ->check(CLI::Validator(whole_between(0, 15), "0 to 15"));
  app->add_option("--out", options.out, "folder for pictures and turn.json")->capture_default_str();
}

}  // namespace

void add_turn(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<TurnOptions>();
  TurnOptions& options = *kept;
  auto* turn =
      app.add_subcommand("turn", "one turn of both robots on the simulated rink: look, decide, throw, follow, count");
  add_turn_options(turn, options);
  turn->add_option("--strategist", options.strategist, "who decides: built-in, or dc:PORT")
      ->capture_default_str()
      ->check(known_strategist);
  turn->add_option("--address", options.address, "where a Digital Curling client may connect: an IPv4 address of ours")
      ->capture_default_str()
      ->check(CLI::ValidIPV4);
  turn->footer(
      "Examples:\n"
      "  hogline turn --seed 3 --stones 6\n"
      "  hogline turn --seer rendered --out out/turn\n"
      "Stones lie where the seed puts them. doc/strategy.md says what happens in a turn.\n"
      "Exit status: 0 thrown and followed to its end, 1 it was not, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  turn->callback([kept, &chosen] { chosen = [kept] { return run_turn(*kept); }; });
}

void add_demo(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<TurnOptions>();
  TurnOptions& options = *kept;
  options.team.seer = "rendered";
  options.team.seed = 3;  // a take-out
  options.out = "out/demo";
  auto* demo = app.add_subcommand("demo", "one turn of both robots in rendered pictures, with a report");
  add_turn_options(demo, options);
  demo->footer(
      "Example:\n"
      "  hogline demo --out out/demo\n"
      "Exit status: 0 thrown and followed to its end, 1 it was not, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk).");
  demo->callback([kept, &chosen] { chosen = [kept] { return run_demo(*kept); }; });
}

void add_game(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<GameOptions>();
  GameOptions& options = *kept;
  auto* game =
      app.add_subcommand("game", "whole ends between two strategists, thrown by both robots on the simulated rink");
  game->add_option("--ends", options.ends, "how many, without extra ones")
      ->capture_default_str()
      ->check(CLI::Validator(whole_between(1, 20), "1 to 20"));
  game->add_option("--practice", options.practice,
                   "draws before the first end, from which the ice is learnt; none counts")
      ->capture_default_str()
      ->check(CLI::Validator(whole_between(0, 16), "0 to 16"));
  game->add_option(
          "--team0", options.first,
          "who decides for the first team, that of the first handles in the rig's stone.teams: built-in, or dc:PORT")
      ->capture_default_str()
      ->check(known_strategist);
  game->add_option("--team1", options.second, "the same for the second team, which has the first end's hammer")
      ->capture_default_str()
      ->check(known_strategist);
  game->add_option("--address", options.address, "where Digital Curling clients may connect: an IPv4 address of ours")
      ->capture_default_str()
      ->check(CLI::ValidIPV4);
  game->add_option("--thinking", options.thinking_s, "each team's time for the whole game, s")
      ->capture_default_str()
      ->check(CLI::Validator(between(1.0, 86400.0), "1.0 to 86400.0"));
  game->add_option("--connect", options.connect_s, "how long clients are waited for, s")
      ->capture_default_str()
      ->check(CLI::Validator(between(1.0, 86400.0), "1.0 to 86400.0"));
  add_robots(game, options.team);
  auto* model =
      game->add_flag("--outcome-model", options.outcome_model,
                     "no robots: FCV1 with an ice of its own and a thrower's errors, thousands of times faster");
  for (const char* robots : {"--rig", "--skip-rig", "--scenario", "--seer", "--skip-hz"})
    model->excludes(game->get_option(robots));
  game->add_option("--out", options.out, "folder for game.jsonl, game.dcl2 and throws.csv")->capture_default_str();
  game->footer(
      "Examples:\n"
      "  hogline game --ends 2 --seed 7\n"
      "  hogline game --ends 8 --team0 dc:10000 --team1 dc:10001 --outcome-model\n"
      "Each stone is thrown by the thrower and followed by the skip, and the ice model learns; what the skip saw is\n"
      "the next board. throws.csv and summary.md say how that agrees with the simulator's truth.\n"
      "A dc:PORT waits for a Digital Curling 3 client; doc/strategy.md says what happens to one that misbehaves.\n"
      "Exit status: 0 played to its end, 1 stopped before, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  game->callback([kept, &chosen] { chosen = [kept] { return run_game(*kept); }; });
}

void add_keys(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<KeysOptions>();
  KeysOptions& options = *kept;
  auto* keys = app.add_subcommand("keys", "keys for the team's link: then nobody else hears it or speaks on it");
  keys->add_option("--out", options.out, "folder for the keys; it must not hold any")->required();
  keys->add_option("--domain", options.domain, "the DDS domain for which they are, as link.domain in the rigs")
      ->capture_default_str()
      ->check(CLI::Validator(whole_between(0, 232), "0 to 232"));
  keys->add_option("--thrower", options.thrower, "name of the robot that throws")->capture_default_str();
  keys->add_option("--skip", options.skip, "name of the robot that orders the shots")->capture_default_str();
  keys->add_option("--observer", options.observers, "name of a machine that may listen and stop all; repeatable");
  keys->add_option("--days", options.days, "how long they hold")
      ->capture_default_str()
      ->check(CLI::Validator(whole_between(1, 3650), "1 to 3650"));
  keys->footer(
      "Examples:\n"
      "  hogline keys --out keys --domain 7\n"
      "  hogline keys --out keys --observer scoreboard --observer coach --days 30\n"
      "Exit status: 0 made, 2 wrong use (a folder that holds keys, a name that is none or that of another file),\n"
      "3 something outside failed (a disk).");
  keys->callback([kept, &chosen] { chosen = [kept] { return run_keys(*kept); }; });
}

void add_link(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<LinkOptions>();
  LinkOptions& options = *kept;
  auto* link = app.add_subcommand("link", "who is on the rig's link, and how far the clocks are apart");
  link->add_option("--rig", options.rig, "rig file (YAML) with a link section: the robot to be")->required();
  link->add_option("--seconds", options.seconds, "how long to listen")
      ->capture_default_str()
      ->check(CLI::Validator(between(0.1, 86400.0), "0.1 to 86400.0"));
  link->add_flag("--json", options.json, "one JSON object a peer");
  link->footer(
      "Sends nothing but heartbeats. Do not run it for a robot whose own program is running.\n"
      "Ctrl-C ends it early; what was heard until then is printed.\n"
      "Example:\n"
      "  hogline link --rig skip.yaml --seconds 5\n"
      "Exit status: 0 all peers are there at the end, 1 one is not, 2 wrong use or configuration,\n"
      "3 something outside failed (no such interface, no keys).");
  link->callback([kept, &chosen] { chosen = [kept] { return run_link(*kept); }; });
}

}  // namespace hogline::cli
