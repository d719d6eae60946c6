// Command lines of the thrower on the simulated rink.
#include <CLI/CLI.hpp>
#include <memory>

#include "src/campaign_command.hpp"
#include "src/cli/commands.hpp"
#include "src/cli/number_checks.hpp"
#include "src/faults_command.hpp"
#include "src/sights_command.hpp"
#include "src/throw_command.hpp"

namespace hogline::cli {
namespace {

void add_shot(CLI::App* app, ThrowOptions& options) {
  app->add_option("--rig", options.rig, "rig file (YAML); without it the practice rig");
  app->add_option("--scenario", options.scenario,
                  "scenario file (YAML) of the simulated rink; without it the practice rink");
  app->add_option("--speed", options.speed_mps, "of the stone at release, m/s")
      ->capture_default_str()
      ->check(any_number);
  app->add_option("--heading-deg", options.heading_deg, "of the shot's line, counter-clockwise from down-ice")

      ->capture_default_str()
      ->check(any_number);
  app->add_option("--curl", options.curl, "the stone's turn seen from above: cw curls right, ccw left")
      ->capture_default_str()
      ->check(CLI::IsMember({"cw", "ccw"}));
  app->add_option("--spin", options.spin_radps, "the stone's rate of turn at release, rad/s")
      ->capture_default_str()
      ->check(any_number);
  app->add_option("--seed", options.seed, "of all that is random in the simulation, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  app->add_option("--out", options.out, "folder for pictures, plots and the log")->capture_default_str();
}

void add_throws(CLI::App* app, CampaignOptions& options) {
  app->add_option("--throws", options.throws, "how many there shall be")
      ->check(CLI::Validator(whole_between(1, 1000000), "1 to 1000000"));
  app->add_option("--rig", options.rig, "rig file (YAML); without it the practice rig");
  app->add_option("--scenario", options.scenario,
                  "scenario file (YAML), each throw drawn from its ranges; without it the practice rink");
  app->add_option("--jobs", options.jobs, "throws at a time")
      ->capture_default_str()
      ->check(CLI::Validator(whole_between(1, 256), "1 to 256"));
  app->add_option("--seed", options.seed, "of the whole campaign, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  app->add_option("--speed", options.speed_mps, "of the stones at release, m/s: a number or LOW..HIGH")
      ->capture_default_str()
      ->check(number_or_range);
  app->add_option("--heading-deg", options.heading_deg, "of the shots' lines: a number or LOW..HIGH")
      ->capture_default_str()
      ->check(number_or_range);
  app->add_option("--spin", options.spin_radps, "the stones' rate of turn, rad/s: a number or LOW..HIGH")
      ->capture_default_str()
      ->check(number_or_range);
  app->add_option("--curl", options.curl, "the stones' turn seen from above")
      ->capture_default_str()
      ->check(CLI::IsMember({"cw", "ccw", "both"}));
  app->add_option("--out", options.out, "folder for tables, summary and plots")->capture_default_str();
}

}  // namespace

void add_throw(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<ThrowOptions>();
  ThrowOptions& options = *kept;
  auto* command = app.add_subcommand("throw", "the thrower on the simulated rink: align, run, release");
  add_shot(command, options);
  command->add_flag("--json", options.json_only, "print nothing but the JSON object");
  command->add_flag("--realtime", options.realtime, "in threads against the wall clock, with the latencies");
  command->add_option(
      "--learn", options.learn,
      "file of what releases have taught of the jaws: read if it is there, and written after the throw");
  command->add_option("--fault", options.fault, "inject a fault: KIND@SECONDS of the run, e.g. camera-freeze@1.0")
      ->check(known_fault);
  command
      ->add_option("--seer", options.seer,
                   "who looks: vision at rendered pictures, or an oracle with its errors; without it rendered, and "
                   "with --from the campaign's")
      ->check(CLI::IsMember({"oracle", "rendered"}));
  auto* from = command->add_option(
      "--from", options.from,
      "a campaign's throw once more, FOLDER/throws.csv:NUMBER; rig, scenario, shot and seed are the row's");
  for (const char* own : {"--rig", "--scenario", "--speed", "--heading-deg", "--curl", "--spin", "--seed", "--learn",
                          "--fault", "--realtime"})
    from->excludes(command->get_option(own));
  command->footer(
      "Examples:\n"
      "  hogline throw --speed 2.09 --heading-deg 0.4 --curl ccw --seed 7 --out out/throw\n"
      "  hogline throw --from out/campaign/throws.csv:17\n"
      "It simulates: whatever devices the rig names, none of them is opened, and nothing real moves.\n"
      "Faults strike KIND@SECONDS after the run begins: camera-* the low camera, drive-* the left wheel.\n"
      "Exit status: 0 the stone was let go in its window, 1 it was not, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  command->callback([kept, &chosen] { chosen = [kept] { return run_throw(*kept); }; });
}

void add_campaign(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<CampaignOptions>();
  CampaignOptions& options = *kept;
  auto* campaign = app.add_subcommand("campaign", "many throws on the simulated rink, as a table and a summary");
  add_throws(campaign, options);
  campaign->add_option("--seer", options.seer, "who looks: rendered pictures and vision, or an oracle with its errors")
      ->capture_default_str()
      ->check(CLI::IsMember({"oracle", "rendered"}));
  auto* draws = campaign->add_flag("--tee-draws", options.tee_draws,
                                   "every shot is solved for the far tee on the scenario's ice");
  for (const char* aimed : {"--speed", "--heading-deg"}) draws->excludes(campaign->get_option(aimed));
  campaign->add_option("--without", options.without, "leave an ingredient out, to see what it buys")
      ->check(CLI::IsMember({"refraction", "latency", "tracking", "visual-alignment"}));
  auto* faults = campaign->add_option(
      "--faults", options.faults, "instead of plain throws: faults at random moments, all or those that mention this");
  for (const char* plain : {"--throws", "--rig", "--scenario", "--speed", "--heading-deg", "--spin", "--curl", "--seer",
                            "--tee-draws", "--without"})
    faults->excludes(campaign->get_option(plain));
  campaign->add_option("--per-fault", options.per_fault, "throws for each fault")
      ->capture_default_str()
      ->needs(faults)
      ->check(CLI::Validator(whole_between(1, 100000), "1 to 100000"));
  campaign->footer(
      "Examples:\n"
      "  hogline campaign --throws 2000 --jobs 2 --out out/oracle\n"
      "  hogline campaign --throws 50 --seer rendered --jobs 2 --seed 7 --out out/rendered\n"
      "  hogline campaign --throws 200 --tee-draws --out out/draws\n"
      "  hogline campaign --faults all --per-fault 20 --jobs 2 --out out/faults\n"
      "A campaign that was stopped goes on where it was when it is called again. The same seed gives the same bytes,\n"
      "however many jobs; DIR/throws.csv has a row a throw.\n"
      "Exit status: 0 every stone was let go in its window, 1 some were not, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  campaign->callback([kept, &chosen] { chosen = [kept] { return run_campaign(*kept); }; });
}

void add_sights(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<CampaignOptions>();
  CampaignOptions& options = *kept;
  options.out = "out/sights";
  auto* sights =
      app.add_subcommand("sights", "how well vision sees on rendered throws: the oracle's figures, measured");
  add_throws(sights, options);
  sights->get_option("--throws")->required();
  sights->footer(
      "Example:\n"
      "  hogline sights --throws 24 --jobs 2 --scenario config/scenarios/anywhere.yaml --out out/sights\n"
      "DIR/sights.csv has a row a look, DIR/oracle.yaml what the oracle of `campaign` is made of; the program carries\n"
      "config/oracles/measured.yaml.\n"
      "Exit status: 0 measured, 1 too little was seen, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  sights->callback([kept, &chosen] { chosen = [kept] { return run_sights(*kept); }; });
}

void add_faults(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<FaultsOptions>();
  FaultsOptions& options = *kept;
  auto* faults = app.add_subcommand("faults", "every fault of the table in a whole simulated throw, as a page");
  faults->add_option("--out", options.out, "the page's file (Markdown); without it stdout");
  faults->add_option("--only", options.only, "only cases whose group, name or way of injection mentions this");
  faults->footer(
      "Examples:\n"
      "  hogline faults --out doc/faults.md\n"
      "  hogline faults --only Gyro\n"
      "Exit status: 0 all ended as they should, 1 some did not (the page says which),\n"
      "3 something outside failed (a disk).");
  faults->callback([kept, &chosen] { chosen = [kept] { return run_faults(*kept); }; });
}

}  // namespace hogline::cli
