// Command lines of the programs that stay: the robots' and the rink's.
#include <CLI/CLI.hpp>
#include <memory>

#include "src/cli/commands.hpp"
#include "src/cli/number_checks.hpp"
#include "src/live/order_words.hpp"
#include "src/order_command.hpp"
#include "src/rink_command.hpp"
#include "src/thrower_command.hpp"

namespace hogline::cli {

void add_rink(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<RinkOptions>();
  RinkOptions& options = *kept;
  auto* rink = app.add_subcommand("rink", "the simulated rink as a program of its own, for `hogline thrower`");
  rink->add_option("--rig", options.rig, "the thrower's rig file (YAML): its lines are served")->required();
  rink->add_option("--skip-rig", options.skip_rig, "the skip's rig file (YAML); without it there is no skip");
  rink->add_option("--scenario", options.scenario, "scenario file (YAML); without it the practice rink");
  rink->add_option("--seed", options.seed, "of all that is random in the simulation, a whole number from 0")
      ->capture_default_str()
      ->check(whole_number);
  rink->add_option("--camera-hz", options.camera_hz, "rate of near and low camera; without it the scenario's")
      ->check(CLI::Validator(between(2.0, 200.0), "2.0 to 200.0"));
  rink->add_option("--skip-hz", options.skip_hz, "rate of the skip's cameras")
      ->capture_default_str()
      ->check(CLI::Validator(between(0.5, 200.0), "0.5 to 200.0"));
  rink->add_option("--truth", options.truth, "file to which what truly happens is appended, a JSON object a line");
  rink->footer(
      "Example:\n"
      "  hogline rink --rig config/rigs/thrower.yaml --camera-hz 15 --truth truth.jsonl\n"
      "A line `again` on its stdin puts the robot back into the hack with the next stone; `quit` ends it.\n"
      "doc/programs.md has the lines that it serves.\n"
      "Exit status: 0 it was told to end, 2 wrong use or configuration, 3 something outside failed (a port).");
  rink->callback([kept, &chosen] { chosen = [kept] { return run_rink(*kept); }; });
}

void add_thrower(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<ThrowerOptions>();
  ThrowerOptions& options = *kept;
  auto* thrower = app.add_subcommand("thrower", "the thrower as a program that stays: orders from the team's link");
  thrower->add_option("--rig", options.rig, "rig file (YAML) with a link and an operator's socket")->required();
  thrower->footer(
      "THE ROBOT MOVES when somebody holds its switch (`hogline hold`) and the link's commander orders a shot.\n"
      "Example:\n"
      "  hogline thrower --rig config/rigs/thrower.yaml\n"
      "doc/programs.md says when it arms, what it takes for an order, and what stops it.\n"
      "Exit status: 0 it was told to end, 2 wrong use or configuration, 3 something outside failed (a port, keys).");
  thrower->callback([kept, &chosen] { chosen = [kept] { return run_thrower(*kept); }; });
}

void add_hold(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<HoldOptions>();
  HoldOptions& options = *kept;
  auto* hold =
      app.add_subcommand("hold", "the operator's hand: presses the dead-man's switch of a robot, and holds it");
  hold->add_option("--rig", options.rig, "the robot's rig file (YAML)")->required();
  hold->add_option("--seconds", options.seconds, "how long; without it until Ctrl-C")
      ->check(CLI::Validator(between(0.1, 86400.0), "0.1 to 86400.0"));
  hold->footer(
      "THE ROBOT MAY MOVE as long as this runs. Ctrl-C lets the switch go.\n"
      "Example:\n"
      "  hogline hold --rig config/rigs/thrower.yaml\n"
      "Exit status: 0 the robot's program heard it to the end, 1 it did not, 2 wrong use or configuration.");
  hold->callback([kept, &chosen] { chosen = [kept] { return run_hold(*kept); }; });
}

void add_order(CLI::App& app, Chosen& chosen) {
  const auto kept = std::make_shared<OrderOptions>();
  OrderOptions& options = *kept;
  auto* order = app.add_subcommand("order", "one shot ordered by hand over the team's link");
  order->add_option("--rig", options.rig, "rig file (YAML) with a link section: the robot to order as")->required();
  order->add_option("--speed", options.speed_mps, "of the stone at release, m/s")
      ->capture_default_str()
      ->check(CLI::Validator(between(OrderLimits::least_speed_mps, OrderLimits::most_speed_mps), "0.5 to 5.0"));
  order->add_option("--heading-deg", options.heading_deg, "of the shot's line, counter-clockwise from down-ice")
      ->capture_default_str()
      ->check(CLI::Validator(between(-OrderLimits::most_heading_deg, OrderLimits::most_heading_deg), "-8.0 to 8.0"));
  order
      ->add_option("--spin", options.spin_radps,
                   "the stone's rate of turn at release, rad/s, counter-clockwise positive")
      ->capture_default_str()
      ->check(CLI::Validator(between(-OrderLimits::most_spin_radps, OrderLimits::most_spin_radps), "-6.0 to 6.0"));
  order->add_option("--wait", options.wait_s, "how long the thrower may take to be armed, s")
      ->capture_default_str()
      ->check(CLI::Validator(between(0.1, 86400.0), "0.1 to 86400.0"));
  order->add_flag("--stay", options.stay, "stay on the link after the throw, until Ctrl-C");
  order->footer(
      "THE THROWER MOVES if its operator has armed it. When this program ends before the throw does, the robot stops.\n"
      "Do not run it for a robot whose own program is running.\n"
      "Example:\n"
      "  hogline order --rig config/rigs/skip_live.yaml --speed 2.1 --spin -1.5\n"
      "Exit status: 0 the stone was let go, 1 it was not, 2 wrong use or configuration, 3 something outside failed.");
  order->callback([kept, &chosen] { chosen = [kept] { return run_order(*kept); }; });
}

}  // namespace hogline::cli
