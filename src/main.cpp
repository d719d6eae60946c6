#include <fmt/ranges.h>
#include <gsl/gsl_errno.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <opencv2/core/utility.hpp>

#include "src/board_command.hpp"
#include "src/campaign_command.hpp"
#include "src/config/config_error.hpp"
#include "src/config/nearest_word.hpp"
#include "src/demo_command.hpp"
#include "src/doctor_command.hpp"
#include "src/exit_status.hpp"
#include "src/faults_command.hpp"
#include "src/game_command.hpp"
#include "src/keys_command.hpp"
#include "src/link_command.hpp"
#include "src/pose_command.hpp"
#include "src/sights_command.hpp"
#include "src/skip/skip_scene.hpp"
#include "src/skip/skip_set.hpp"
#include "src/skip_command.hpp"
#include "src/stones_command.hpp"
#include "src/throw_command.hpp"
#include "src/track_command.hpp"

namespace {

using hogline::ExitStatus;

// GSL's default handler aborts the program on a singular matrix; results are checked for finiteness instead.
void prepare_libraries() {
  gsl_set_error_handler_off();
  cv::setNumThreads(1);
}

// CLI11 would wrap -1 around.
std::string whole_number(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 18 && text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::string() : "'" + text + "' is no whole number from 0 to 999999999999999999";
}

CLI::App* add_pose(CLI::App& app, hogline::PoseOptions& options) {
  auto* pose = app.add_subcommand("pose", "the sheet's pose from pictures, one JSON object a line");
  pose->add_option("--rig", options.rig, "rig file (YAML): the camera and what is known of the sheet")->required();
  pose->add_option("--camera", options.camera, "which camera of the rig took the pictures")
      ->required()
      ->check(CLI::IsMember({"near", "low"}));
  pose->add_flag("--sequence", options.sequence,
                 "the pictures are consecutive frames: each is predicted from those before");
  pose->add_option("--rate", options.rate_hz, "frames a second of the sequence; without it 60, and a video's own");
  pose->add_option("--draw", options.draw, "folder for the pictures with what was seen drawn on them");
  pose->add_option(
          "IMAGE", options.images,
          "pictures as the camera gives them, or one recording of them: a folder, a video, a stamps file (.csv)")
      ->required();
  pose->footer(
      "Examples:\n"
      "  hogline pose --rig rig.yaml --camera near frame.jpg\n"
      "  hogline pose --rig rig.yaml --camera near --sequence --rate 60 turn-*.jpg\n"
      "  hogline pose --rig rig.yaml --camera low --sequence --rate 60 run-*.jpg\n"
      "  hogline pose --rig rig.yaml --camera low --sequence run.mp4\n"
      "A stamps file has the first line name,id,time_s and then a line for each picture.\n"
      "A picture that can not be read is one that is not estimated: its line says why, and the rest go on.\n"
      "Exit status: 0 all estimated, 1 some picture not estimated, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  return pose;
}

CLI::App* add_stones(CLI::App& app, hogline::StonesOptions& options) {
  auto* stones = app.add_subcommand("stones", "the stones on the sheet from pictures of the near or the far camera");
  stones->add_option("--rig", options.rig, "rig file (YAML): the camera, the sheet and the stones' handles")
      ->required();
  stones->add_option("--camera", options.camera, "which camera of the rig took the pictures")
      ->capture_default_str()
      ->check(CLI::IsMember({"near", "far"}));
  stones
      ->add_option("--at", options.at,
                   "with --camera far: where the body stands, X_M,Y_M,YAW_DEG, as the near view measured it")
      ->type_name("X_M,Y_M,YAW_DEG");
  stones->add_flag("--sequence", options.sequence,
                   "the pictures are of one robot that stands still: one line with their stones' means");
  stones->add_option("--draw", options.draw, "folder for the pictures with what was seen drawn on them");
  stones
      ->add_option("IMAGE", options.images,
                   "pictures as the camera gives them, or one recording of them: a folder, a video, a stamps file")
      ->required();
  stones->footer(
      "Prints one JSON object a line, places in metres from the tee of the house in view.\n"
      "Examples:\n"
      "  hogline stones --rig rig.yaml frame.jpg\n"
      "  hogline stones --rig rig.yaml --sequence frame-*.jpg\n"
      "  hogline stones --rig rig.yaml --camera far --at=-0.15,-3.51,1.1 far.jpg\n"
      "The far camera's mount in the rig is with the head's pan and tilt of the picture; what the picture shows of "
      "the\n"
      "sheet corrects it by up to a degree.\n"
      "A picture that can not be read is one that is not estimated: its line says why, and the rest go on.\n"
      "Exit status: 0 all estimated, 1 some picture not estimated (of a sequence: none), 2 wrong use or\n"
      "configuration.");
  return stones;
}

CLI::App* add_board(CLI::App& app, hogline::BoardOptions& options) {
  auto* board = app.add_subcommand("board", "what lies on the sheet under the rules, printed and drawn");
  board->add_option("--rig", options.rig, "rig file (YAML): the camera, the sheet and the stones' handles")->required();
  board->add_option("--out", options.out, "folder for the drawing");
  board->add_option("IMAGE", options.images, "pictures of one robot that stands still; their stones are averaged")
      ->required();
  board->footer(
      "Example:\n"
      "  hogline board --rig rig.yaml --out out/board frame-*.jpg\n"
      "Exit status: 0 seen, 1 not seen in any picture, 2 wrong use or configuration.");
  return board;
}

void add_shot(CLI::App* app, hogline::ThrowOptions& options) {
  app->add_option("--rig", options.rig, "rig file (YAML); without it the practice rig");
  app->add_option("--scenario", options.scenario,
                  "scenario file (YAML) of the simulated rink; without it the practice rink");
  app->add_option("--speed", options.speed_mps, "of the stone at release, m/s")->capture_default_str();
  app->add_option("--heading-deg", options.heading_deg, "of the shot's line, counter-clockwise from down-ice")
      ->capture_default_str();
  app->add_option("--curl", options.curl, "the stone's turn seen from above: cw curls right, ccw left")
      ->capture_default_str()
      ->check(CLI::IsMember({"cw", "ccw"}));
  app->add_option("--spin", options.spin_radps, "the stone's rate of turn at release, rad/s")->capture_default_str();
  app->add_option("--seed", options.seed, "of all that is random in the simulation, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  app->add_option("--out", options.out, "folder for pictures, plots and the log")->capture_default_str();
}

CLI::App* add_throw(CLI::App& app, hogline::ThrowOptions& options) {
  auto* command = app.add_subcommand("throw", "the thrower on the simulated rink: align, run, release");
  add_shot(command, options);
  command->add_flag("--json", options.json_only, "print nothing but the JSON object");
  command->add_flag("--realtime", options.realtime, "in threads against the wall clock, with the latencies");
  command->add_option(
      "--learn", options.learn,
      "file of what releases have taught of the jaws: read if it is there, and written after the throw");
  command->add_option("--fault", options.fault, "inject a fault: KIND@SECONDS of the run, e.g. camera-freeze@1.0")
      ->check(hogline::known_fault);
  command->add_option("--seer", options.seer, "who looks: vision at rendered pictures, or an oracle with its errors")
      ->check(CLI::IsMember({"oracle", "rendered"}));
  command->add_option(
      "--from", options.from,
      "a campaign's throw once more, FOLDER/throws.csv:NUMBER; rig, scenario, shot and seed are the row's");
  command->footer(
      "Examples:\n"
      "  hogline throw --speed 2.09 --heading-deg 0.4 --curl ccw --seed 7 --out out/throw\n"
      "  hogline throw --from out/campaign/throws.csv:17\n"
      "It simulates: whatever devices the rig names, none of them is opened, and nothing real moves.\n"
      "Faults strike KIND@SECONDS after the run begins: camera-* the low camera, drive-* the left wheel.\n"
      "Exit status: 0 the stone was let go in its window, 1 it was not, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  return command;
}

void add_throws(CLI::App* app, hogline::CampaignOptions& options) {
  app->add_option("--throws", options.throws, "how many there shall be")->check(CLI::Range(1, 1000000));
  app->add_option("--rig", options.rig, "rig file (YAML); without it the practice rig");
  app->add_option("--scenario", options.scenario,
                  "scenario file (YAML), each throw drawn from its ranges; without it the practice rink");
  app->add_option("--jobs", options.jobs, "throws at a time")->capture_default_str()->check(CLI::Range(1, 256));
  app->add_option("--seed", options.seed, "of the whole campaign, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  app->add_option("--speed", options.speed_mps, "of the stones at release, m/s: a number or LOW..HIGH")
      ->capture_default_str()
      ->check(hogline::number_or_range);
  app->add_option("--heading-deg", options.heading_deg, "of the shots' lines: a number or LOW..HIGH")
      ->capture_default_str()
      ->check(hogline::number_or_range);
  app->add_option("--spin", options.spin_radps, "the stones' rate of turn, rad/s: a number or LOW..HIGH")
      ->capture_default_str()
      ->check(hogline::number_or_range);
  app->add_option("--curl", options.curl, "the stones' turn seen from above")
      ->capture_default_str()
      ->check(CLI::IsMember({"cw", "ccw", "both"}));
  app->add_option("--out", options.out, "folder for tables, summary and plots")->capture_default_str();
}

CLI::App* add_campaign(CLI::App& app, hogline::CampaignOptions& options) {
  auto* campaign = app.add_subcommand("campaign", "many throws on the simulated rink, as a table and a summary");
  add_throws(campaign, options);
  campaign->add_option("--seer", options.seer, "who looks: rendered pictures and vision, or an oracle with its errors")
      ->capture_default_str()
      ->check(CLI::IsMember({"oracle", "rendered"}));
  campaign->add_flag(
      "--tee-draws", options.tee_draws,
      "every shot is solved for the far tee on the scenario's ice; --speed and --heading-deg do not count");
  campaign->add_option("--without", options.without, "leave an ingredient out, to see what it buys")
      ->check(CLI::IsMember({"refraction", "latency", "tracking", "visual-alignment"}));
  campaign->add_option("--faults", options.faults,
                       "instead of plain throws: faults at random moments, all or those with this in their name");
  campaign->add_option("--per-fault", options.per_fault, "throws for each fault")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
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
  return campaign;
}

CLI::App* add_sights(CLI::App& app, hogline::CampaignOptions& options) {
  auto* sights =
      app.add_subcommand("sights", "how well vision sees on rendered throws: the oracle's figures, measured");
  add_throws(sights, options);
  sights->footer(
      "Example:\n"
      "  hogline sights --throws 24 --jobs 2 --scenario config/scenarios/anywhere.yaml --out out/sights\n"
      "DIR/sights.csv has a row a look, DIR/oracle.yaml what the oracle of `campaign` is made of; the program carries\n"
      "config/oracles/measured.yaml.\n"
      "Exit status: 0 measured, 1 too little was seen, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  return sights;
}

CLI::App* add_demo(CLI::App& app, hogline::ThrowOptions& options) {
  auto* demo = app.add_subcommand("demo", "one whole throw on the simulated rink, with pictures and a report");
  add_shot(demo, options);
  demo->footer(
      "Example:\n"
      "  hogline demo --out out/demo\n"
      "Exit status: 0 the stone was let go in its window, 1 it was not, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk).");
  return demo;
}

CLI::App* add_doctor(CLI::App& app, hogline::DoctorOptions& options) {
  auto* doctor =
      app.add_subcommand("doctor", "every device of a rig: what is found, what is wrong, what to do; moves nothing");
  doctor->add_option("--rig", options.rig, "rig file (YAML)")->required();
  doctor->add_flag("--simulated", options.simulated, "examine the simulated rink in the place of the rig's devices");
  doctor->add_flag("--json", options.json, "one JSON object instead of a table");
  doctor->footer(
      "Examples:\n"
      "  hogline doctor --rig rig.yaml\n"
      "  hogline doctor --rig config/rigs/practice.yaml --simulated --json\n"
      "It listens and reads; nothing is switched on and nothing is ordered. A rig whose cameras are all simulated is\n"
      "examined on the simulated rink. Takes two to thirty seconds.\n"
      "Exit status: 0 all well (notes do not count), 1 something is wrong, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  return doctor;
}

CLI::App* add_faults(CLI::App& app, hogline::FaultsOptions& options) {
  auto* faults = app.add_subcommand("faults", "every fault of the table in a whole simulated throw, as a page");
  faults->add_option("--out", options.out, "the page's file (Markdown); without it stdout");
  faults->add_option("--only", options.only, "only cases whose group, name or way of injection contains this");
  faults->footer(
      "Examples:\n"
      "  hogline faults --out doc/faults.md\n"
      "  hogline faults --only Gyro\n"
      "Exit status: 0 all ended as they should, 1 some did not (the page says which),\n"
      "3 something outside failed (a disk).");
  return faults;
}

CLI::App* add_game(CLI::App& app, hogline::GameOptions& options) {
  auto* game = app.add_subcommand("game", "whole ends between two strategists, on an outcome model of throws");
  game->add_option("--ends", options.ends, "how many, without extra ones")
      ->capture_default_str()
      ->check(CLI::Range(1, 20));
  game->add_option("--team0", options.first, "who decides for the first team: built-in, or dc:PORT")
      ->capture_default_str()
      ->check(hogline::known_strategist);
  game->add_option("--team1", options.second, "the same for the second team, which has the first end's hammer")
      ->capture_default_str()
      ->check(hogline::known_strategist);
  game->add_option("--address", options.address, "where Digital Curling clients may connect: an IPv4 address of ours")
      ->capture_default_str()
      ->check(CLI::ValidIPV4);
  game->add_option("--thinking", options.thinking_s, "each team's time for the whole game, s")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 86400.0));
  game->add_option("--connect", options.connect_s, "how long clients are waited for, s")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 86400.0));
  game->add_option("--seed", options.seed, "of the ice and of the throws, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  game->add_option("--out", options.out, "folder for game.jsonl and game.dcl2")->capture_default_str();
  game->footer(
      "Examples:\n"
      "  hogline game --ends 4 --seed 7\n"
      "  hogline game --ends 8 --team0 dc:10000 --team1 dc:10001\n"
      "No robot moves: FCV1 with an ice of its own, a thrower's errors, collisions, and an ice model that learns.\n"
      "A dc:PORT waits for a Digital Curling 3 client; doc/strategy.md says what happens to one that misbehaves.\n"
      "Exit status: 0 played to its end, 1 stopped before, 2 wrong use or configuration,\n"
      "3 something outside failed (a disk, a port).");
  return game;
}

CLI::App* add_skip(CLI::App& app, hogline::SkipOptions& options) {
  auto* skip = app.add_subcommand("skip", "the skip on the simulated rink: look, aim, follow the thrown stone to rest");
  skip->add_option("--rig", options.rig, "rig file (YAML); without it the practice skip");
  skip->add_option("--scenario", options.scenario,
                   "scenario file (YAML) of the simulated rink; without it the practice rink");
  skip->add_option("--throw", options.kind, "what is thrown; the seed draws the rest")
      ->capture_default_str()
      ->check(CLI::IsMember(hogline::throw_kind_names()));
  skip->add_option("--seed", options.seed, "of all that is random in the simulation, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  skip->add_option("--number", options.number, "this throw of the set that `hogline skips` measures, instead")
      ->check(CLI::Range(0, hogline::throws_in_set - 1));
  skip->add_flag("--oracle", options.oracle, "the simulator's truth with errors instead of rendered pictures");
  skip->add_flag("--unannounced", options.unannounced,
                 "the thrower does not tell when it lets go, nor which way it turns");
  skip->add_option("--far-hz", options.far_hz, "rate of the far camera; without it the scenario's")
      ->check(CLI::Range(2.0, 200.0));
  skip->add_option("--near-hz", options.near_hz, "rate of the near camera; without it the scenario's")
      ->check(CLI::Range(2.0, 200.0));
  skip->add_option("--ice", options.ice,
                   "file of what throws have taught of the ice: read if it is there, and written after the throw");
  skip->add_option("--out", options.out, "folder for result.json, trajectory.csv and above.png")->capture_default_str();
  skip->add_option("--record", options.record, "folder for the pictures that were looked at, for `hogline track`");
  skip->add_flag("--json", options.json_only, "print nothing but the JSON object");
  skip->footer(
      "Examples:\n"
      "  hogline skip --throw double --seed 7 --oracle --out out/skip\n"
      "  hogline skip --throw draw --far-hz 10 --near-hz 10 --ice sheet4.yaml\n"
      "It simulates: whatever devices the rig names, none of them is opened, and nothing real moves.\n"
      "doc/skip.md says what the JSON object holds.\n"
      "Exit status: 0 the throw was followed to its end, 1 it was not (the reason says why), 2 wrong use or\n"
      "configuration, 3 something outside failed (a disk).");
  return skip;
}

CLI::App* add_track(CLI::App& app, hogline::TrackOptions& options) {
  auto* track = app.add_subcommand("track", "a recorded throw, followed as the skip follows a live one");
  track->add_option("--rig", options.rig, "rig file (YAML) of the skip whose cameras took the pictures")->required();
  track->add_option("--at", options.at,
                    "X_M,Y_M,YAW_DEG of the body in the end's frame; without it the near view measures it while the "
                    "head stands");
  track->add_option("--spin", options.spin_radps,
                    "the stone's rate of turn at release, rad/s, counter-clockwise positive; without it not known");
  track->add_option("--ice", options.ice,
                    "file of what throws have taught of the ice: read if it is there, and written afterwards");
  track->add_option("--out", options.out, "folder for result.json, trajectory.csv and above.png")
      ->capture_default_str();
  track
      ->add_option("FOLDER", options.folder,
                   "of the recording: near.csv and far.csv (name,id,time_s), one of them at least, and head.csv "
                   "(time_s,pan_deg,tilt_deg)")
      ->required();
  track->footer(
      "Examples:\n"
      "  hogline skip --throw hit --seed 3 --far-hz 10 --near-hz 10 --record out/recorded\n"
      "  hogline track --rig config/rigs/skip.yaml --out out/track out/recorded\n"
      "  hogline track --rig rig.yaml --at 0.1,-4.1,0.5 --spin 1.57 only_far_pictures\n"
      "doc/skip.md says what the JSON object holds.\n"
      "Exit status: 0 the throw was followed to its end, 1 it was not (the reason says why), 2 wrong use or\n"
      "configuration, 3 something outside failed (a disk).");
  return track;
}

CLI::App* add_skips(CLI::App& app, hogline::SkipsOptions& options) {
  auto* skips = app.add_subcommand("skips", "the set of 40 throws on which the skip is measured, as a table");
  skips->add_option("--rig", options.rig, "rig file (YAML); without it the practice skip");
  skips->add_option("--scenario", options.scenario, "scenario file (YAML); without it the practice rink");
  skips->add_option("--seed", options.seed, "of the first throw, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  skips->add_option("--only", options.only, "this many throws, spread over the set")
      ->check(CLI::Range(1, hogline::throws_in_set));
  skips->add_option("--jobs", options.jobs, "throws at a time")->capture_default_str()->check(CLI::Range(1, 256));
  skips->add_flag("--oracle", options.oracle, "the simulator's truth with errors instead of rendered pictures");
  skips->add_option("--far-hz", options.far_hz, "rate of the far camera")->check(CLI::Range(2.0, 200.0));
  skips->add_option("--near-hz", options.near_hz, "rate of the near camera")->check(CLI::Range(2.0, 200.0));
  skips->add_option("--out", options.out, "folder for throws.csv and table.md")->capture_default_str();
  skips->footer(
      "Example:\n"
      "  hogline skips --oracle --out out/skips\n"
      "Exit status: 0 every throw was followed and nothing taken for something else, 1 not, 2 wrong use or\n"
      "configuration, 3 something outside failed (a disk).");
  return skips;
}

CLI::App* add_keys(CLI::App& app, hogline::KeysOptions& options) {
  auto* keys = app.add_subcommand("keys", "keys for the team's link: then nobody else hears it or speaks on it");
  keys->add_option("--out", options.out, "folder for the keys; it must not hold any")->required();
  keys->add_option("--domain", options.domain, "the DDS domain for which they are, as link.domain in the rigs")
      ->capture_default_str()
      ->check(CLI::Range(0, 232));
  keys->add_option("--thrower", options.thrower, "name of the robot that throws")->capture_default_str();
  keys->add_option("--skip", options.skip, "name of the robot that orders the shots")->capture_default_str();
  keys->add_option("--observer", options.observers, "name of a machine that may listen and stop all; repeatable");
  keys->add_option("--days", options.days, "how long they hold")->capture_default_str()->check(CLI::Range(1, 3650));
  keys->footer(
      "Examples:\n"
      "  hogline keys --out keys --domain 7\n"
      "  hogline keys --out keys --observer scoreboard --observer coach --days 30\n"
      "Exit status: 0 made, 2 wrong use (a folder that holds keys, a name that is none),\n"
      "3 something outside failed (a disk).");
  return keys;
}

CLI::App* add_link(CLI::App& app, hogline::LinkOptions& options) {
  auto* link = app.add_subcommand("link", "who is on the rig's link, and how far the clocks are apart");
  link->add_option("--rig", options.rig, "rig file (YAML) with a link section: the robot to be")->required();
  link->add_option("--seconds", options.seconds, "how long to listen")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 86400.0));
  link->add_flag("--json", options.json, "one JSON object a peer");
  link->footer(
      "Sends nothing but heartbeats. Do not run it for a robot whose own program is running.\n"
      "Example:\n"
      "  hogline link --rig skip.yaml --seconds 5\n"
      "Exit status: 0 all peers are there at the end, 1 one is not, 2 wrong use or configuration,\n"
      "3 something outside failed (no such interface, no keys).");
  return link;
}

// The parser itself would only say that a word was not expected.
void check_subcommand(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (std::ranges::find(known, argv[1]) != known.end()) return;
  const std::string meant = hogline::config::nearest_word(argv[1], known);
  throw hogline::config::ConfigError(
      "command line", 0, "subcommand", argv[1],
      fmt::format("unknown; {}there are {}", meant.empty() ? "" : "did you mean " + meant + "? ",
                  fmt::join(known, ", ")));
}

int run(int argc, char** argv) {
  CLI::App app{"hogline: visual servoing for a team of two curling robots", "hogline"};
  app.set_version_flag("--version", HOGLINE_VERSION);
  app.require_subcommand(1);
  hogline::PoseOptions pose_options;
  hogline::StonesOptions stones_options;
  hogline::BoardOptions board_options;
  hogline::ThrowOptions throw_options;
  hogline::ThrowOptions demo_options;
  demo_options.out = "out/demo";
  const auto* pose = add_pose(app, pose_options);
  const auto* stones = add_stones(app, stones_options);
  const auto* board = add_board(app, board_options);
  const auto* throwing = add_throw(app, throw_options);
  const auto* demo = add_demo(app, demo_options);
  hogline::DoctorOptions doctor_options;
  const auto* doctor = add_doctor(app, doctor_options);
  hogline::GameOptions game_options;
  const auto* game = add_game(app, game_options);
  hogline::FaultsOptions faults_options;
  const auto* faults = add_faults(app, faults_options);
  hogline::CampaignOptions campaign_options;
  const auto* campaign = add_campaign(app, campaign_options);
  hogline::CampaignOptions sights_options;
  sights_options.out = "out/sights";
  const auto* sights = add_sights(app, sights_options);
  hogline::SkipOptions skip_options;
  const auto* skip = add_skip(app, skip_options);
  hogline::TrackOptions track_options;
  const auto* track = add_track(app, track_options);
  hogline::SkipsOptions skips_options;
  const auto* skips = add_skips(app, skips_options);
  hogline::KeysOptions keys_options;
  const auto* keys = add_keys(app, keys_options);
  hogline::LinkOptions link_options;
  const auto* link = add_link(app, link_options);
  check_subcommand(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? ExitStatus::success : ExitStatus::wrong_use;
  }
  if (*pose) return hogline::run_pose(pose_options);
  if (*stones) return hogline::run_stones(stones_options);
  if (*board) return hogline::run_board(board_options);
  if (*throwing) return hogline::run_throw(throw_options);
  if (*doctor) return hogline::run_doctor(doctor_options);
  if (*game) return hogline::run_game(game_options);
  if (*faults) return hogline::run_faults(faults_options);
  if (*keys) return hogline::run_keys(keys_options);
  if (*link) return hogline::run_link(link_options);
  if (*campaign) return hogline::run_campaign(campaign_options);
  if (*sights) return hogline::run_sights(sights_options);
  if (*skip) return hogline::run_skip(skip_options);
  if (*track) return hogline::run_track(track_options);
  if (*skips) return hogline::run_skips(skips_options);
  if (*demo) return hogline::run_demo(demo_options);
  return ExitStatus::wrong_use;
}

}  // namespace

int main(int argc, char** argv) {
  prepare_libraries();
  try {
    const int status = run(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    std::fputs("hogline: the output can not be written: is the disk full?\n", stderr);
    return ExitStatus::failed;
  } catch (const hogline::config::ConfigError& e) {
    std::fprintf(stderr, "hogline: %s\n", e.what());
    return ExitStatus::wrong_use;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "hogline: %s\n", e.what());
    return ExitStatus::failed;
  }
}
